#nullable disable
using System;
using System.Linq;
using System.Reflection;
using System.Runtime.InteropServices;
using System.Threading.Tasks;

// As much of native arrays and jobs as the package and its page use, with the same names and signatures.

namespace Unity.Collections
{
    public enum Allocator
    {
        TempJob = 3,
        Persistent = 4,
    }

    [AttributeUsage(AttributeTargets.Field)]
    public sealed class ReadOnlyAttribute : Attribute
    {
    }

    [AttributeUsage(AttributeTargets.Field)]
    public sealed class WriteOnlyAttribute : Attribute
    {
    }

    public unsafe struct NativeArray<T> : IDisposable where T : struct
    {
        internal IntPtr Memory;

        public NativeArray(int length, Allocator allocator)
        {
            Length = length;
            Memory = Marshal.AllocHGlobal(Math.Max(1, length * Marshal.SizeOf<T>()));
            new Span<byte>((void*)Memory, length * Marshal.SizeOf<T>()).Clear();
        }

        public NativeArray(T[] array, Allocator allocator) : this(array.Length, allocator)
        {
            for (int i = 0; i < array.Length; i++) this[i] = array[i];
        }

        public int Length { get; private set; }

        public bool IsCreated => Memory != IntPtr.Zero;

        public T this[int index]
        {
            get => Marshal.PtrToStructure<T>(Place(index));
            set => Marshal.StructureToPtr(value, Place(index), false);
        }

        public T[] ToArray()
        {
            NativeArray<T> array = this;
            return Enumerable.Range(0, Length).Select(i => array[i]).ToArray();
        }

        public void Dispose()
        {
            Marshal.FreeHGlobal(Memory);
            Memory = IntPtr.Zero;
            Length = 0;
        }

        private IntPtr Place(int index) =>
            index >= 0 && index < Length ? Memory + index * Marshal.SizeOf<T>() : throw new IndexOutOfRangeException();
    }
}

namespace Unity.Collections.LowLevel.Unsafe
{
    public static unsafe class NativeArrayUnsafeUtility
    {
        public static void* GetUnsafePtr<T>(this NativeArray<T> nativeArray) where T : struct =>
            MemoryOf(nativeArray);

        public static void* GetUnsafeReadOnlyPtr<T>(this NativeArray<T> nativeArray) where T : struct =>
            MemoryOf(nativeArray);

        // As the safety checks of the editor do.
        private static void* MemoryOf<T>(NativeArray<T> array) where T : struct => array.IsCreated
            ? (void*)array.Memory
            : throw new ObjectDisposedException(nameof(array));
    }
}

namespace Unity.Jobs
{
    public interface IJob
    {
        void Execute();
    }

    public struct JobHandle
    {
        internal Task Task;

        public bool IsCompleted => Task == null || Task.IsCompleted;

        public void Complete() => Task?.GetAwaiter().GetResult();
    }

    public static class IJobExtensions
    {
        public static JobHandle Schedule<T>(this T jobData, JobHandle dependsOn = default) where T : struct, IJob
        {
            RefuseReferences(typeof(T));
            return new JobHandle { Task = Task.Run(() => jobData.Execute()) };
        }

        // As Unity does: a job is copied to native memory.
        private static void RefuseReferences(Type type)
        {
            foreach (FieldInfo field in type.GetFields(
                BindingFlags.Instance | BindingFlags.Public | BindingFlags.NonPublic))
            {
                if (!field.FieldType.IsValueType)
                    throw new InvalidOperationException($"{type.Name}.{field.Name} is not a value type.");
                if (!field.FieldType.IsPrimitive) RefuseReferences(field.FieldType);
            }
        }
    }
}
