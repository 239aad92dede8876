using System;
using System.Linq;
using System.Reflection;
using System.Runtime.InteropServices;
#if NET
using System.Diagnostics.CodeAnalysis;
#endif

namespace Geoidx
{
    /// <summary>How the elements of an array are the positions of vertices.</summary>
    internal readonly unsafe struct MeshLayout
    {
        private readonly PositionType type;
        private readonly int stride;
        private readonly int elementsPerVertex;

        private MeshLayout(PositionType type, int stride, int elementsPerVertex)
        {
            this.type = type;
            this.stride = stride;
            this.elementsPerVertex = elementsPerVertex;
        }

        internal static MeshLayout Of<TVertex>(PositionType? given) where TVertex : unmanaged
        {
            if (typeof(TVertex) == typeof(float)) return new MeshLayout(PositionType.Float, 0, 3);
            if (typeof(TVertex) == typeof(double)) return new MeshLayout(PositionType.Double, 0, 3);
            PositionType type = given ?? TypeOfFirstField(typeof(TVertex));
            int needed = 3 * (type == PositionType.Double ? sizeof(double) : sizeof(float));
            if (sizeof(TVertex) >= needed) return new MeshLayout(type, sizeof(TVertex), 1);
            throw new GeodesicArgumentException(
                $"{typeof(TVertex)} has {sizeof(TVertex)} bytes, a position needs {needed}.");
        }

        // Of structs within structs the innermost one's; float unless it is a double.
#if NET
        [UnconditionalSuppressMessage(
            "Trimming", "IL2070", Justification = "A struct of an array keeps its fields, which are its layout.")]
#endif
        private static PositionType TypeOfFirstField(Type type)
        {
            while (type is { IsValueType: true, IsPrimitive: false, IsEnum: false })
            {
                FieldInfo? first = type
                    .GetFields(BindingFlags.Instance | BindingFlags.Public | BindingFlags.NonPublic)
                    .OrderBy(field => field.GetCustomAttribute<FieldOffsetAttribute>()?.Value ?? 0)
                    .FirstOrDefault();
                if (first == null) break;
                type = first.FieldType;
            }
            return type == typeof(double) ? PositionType.Double : PositionType.Float;
        }

        internal NativeMesh Describe(int elements, int corners)
        {
            if (elements % elementsPerVertex != 0)
                throw new GeodesicArgumentException($"{elements} coordinates are not three a vertex.");
            if (corners % 3 != 0)
                throw new GeodesicArgumentException($"{corners} indices are not three a triangle.");
            NativeMesh mesh = NativeDefaults.Mesh();
            mesh.position_type = (uint)type;
            mesh.position_stride = (uint)stride;
            mesh.vertex_count = (ulong)(elements / elementsPerVertex);
            mesh.triangle_count = (ulong)(corners / 3);
            return mesh;
        }
    }
}
