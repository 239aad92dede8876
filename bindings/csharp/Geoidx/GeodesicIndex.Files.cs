using System;
using System.Collections.Generic;
using System.IO;
using System.Runtime.CompilerServices;
using System.Runtime.InteropServices;

namespace Geoidx
{
    public sealed partial class GeodesicIndex
    {
        /// <summary>Opens an index from a file.</summary>
        /// <param name="path">Of the file.</param>
        /// <param name="options">Null: the defaults.</param>
        /// <exception cref="ArgumentException">The path has half of a surrogate pair.</exception>
        /// <exception cref="GeodesicIOException">The file cannot be read.</exception>
        /// <exception cref="GeodesicDataException">It is no index, or damaged.</exception>
        /// <exception cref="GeodesicVersionException">It was written by a newer format.</exception>
        /// <exception cref="GeodesicMeshMismatchException">
        /// It belongs to another mesh than the expected one.
        /// </exception>
        /// <exception cref="GeodesicLimitException">It asks for more than the options allow.</exception>
        public static GeodesicIndex Open(string path, OpenOptions? options = null)
        {
            string checkedPath = NativeText.CheckedPath(path);
            GeodesicLibrary.Load();
            return new GeodesicIndex(IndexHandle.Open(checkedPath, options));
        }

        /// <summary>Opens an index from memory, which is not needed afterwards.</summary>
        /// <inheritdoc cref="Open(string, OpenOptions?)"/>
        /// <param name="data">The bytes of a file.</param>
        /// <param name="options">Null: the defaults.</param>
        public static GeodesicIndex Open(ReadOnlySpan<byte> data, OpenOptions? options = null)
        {
            GeodesicLibrary.Load();
            return new GeodesicIndex(IndexHandle.Open(data, options));
        }

        /// <summary>Opens an index from a stream, which is read to its end, up to 2 GB.</summary>
        /// <inheritdoc cref="Open(string, OpenOptions?)"/>
        /// <param name="stream">Begins with the index.</param>
        /// <param name="options">Null: the defaults.</param>
        public static GeodesicIndex Open(Stream stream, OpenOptions? options = null)
        {
            if (stream == null) throw new ArgumentNullException(nameof(stream));
            using var bytes = new MemoryStream();
            stream.CopyTo(bytes);
            return Open(new ReadOnlySpan<byte>(bytes.GetBuffer(), 0, (int)bytes.Length), options);
        }

        /// <summary>
        /// Writes the index to a file, replacing what is there: a failure leaves neither a partial file nor a damaged
        /// old one.
        /// </summary>
        /// <param name="path">Of the file.</param>
        /// <param name="codec">The form of the file. Null: <see cref="GeodesicInfo.Codec"/>.</param>
        /// <param name="positions">
        /// False leaves out those of the vertices, some 3.5 bytes each; the file then opens with
        /// <see cref="OpenOptions.ExpectedMesh"/> only. Null: <see cref="GeodesicInfo.HasPositions"/>.
        /// </param>
        /// <param name="mesh">False leaves out the mesh that the index keeps.</param>
        /// <exception cref="ArgumentException">The path has half of a surrogate pair.</exception>
        /// <exception cref="GeodesicArgumentException">The codec is none.</exception>
        /// <exception cref="GeodesicIOException">The file cannot be written.</exception>
        public unsafe void Save(string path, GeodesicCodec? codec = null, bool? positions = null, bool mesh = true)
        {
            NativeSaveOptions options = NativeOptions(codec, positions, mesh);
            NativeMethods.geoidx_save(Handle, NativeText.CheckedPath(path), &options).ThrowIfError();
        }

        /// <summary>Writes the bytes of a file to a stream.</summary>
        /// <param name="stream">Takes the bytes.</param>
        /// <param name="codec">The form of the file. Null: <see cref="GeodesicInfo.Codec"/>.</param>
        /// <param name="positions">
        /// False leaves out those of the vertices, some 3.5 bytes each; the file then opens with
        /// <see cref="OpenOptions.ExpectedMesh"/> only. Null: <see cref="GeodesicInfo.HasPositions"/>.
        /// </param>
        /// <param name="mesh">False leaves out the mesh that the index keeps.</param>
        /// <exception cref="GeodesicArgumentException">The codec is none.</exception>
        public void Save(Stream stream, GeodesicCodec? codec = null, bool? positions = null, bool mesh = true)
        {
            if (stream == null) throw new ArgumentNullException(nameof(stream));
            byte[] bytes = ToBytes(codec, positions, mesh);
            stream.Write(bytes, 0, bytes.Length);
        }

        /// <summary>The bytes of a file, up to 2 GB.</summary>
        /// <param name="codec">The form of the file. Null: <see cref="GeodesicInfo.Codec"/>.</param>
        /// <param name="positions">
        /// False leaves out those of the vertices, some 3.5 bytes each; the file then opens with
        /// <see cref="OpenOptions.ExpectedMesh"/> only. Null: <see cref="GeodesicInfo.HasPositions"/>.
        /// </param>
        /// <param name="mesh">False leaves out the mesh that the index keeps.</param>
        /// <exception cref="GeodesicArgumentException">The codec is none.</exception>
        public unsafe byte[] ToBytes(GeodesicCodec? codec = null, bool? positions = null, bool mesh = true)
        {
            NativeSaveOptions options = NativeOptions(codec, positions, mesh);
            NativeMethods.geoidx_save_memory(Handle, &options, null, 0, out ulong size).ThrowIfError();
            var bytes = new byte[checked((int)size)];
            fixed (byte* first = bytes)
                NativeMethods.geoidx_save_memory(Handle, &options, first, size, out _).ThrowIfError();
            return bytes;
        }

        /// <summary>Checks the bytes of a file as opening does, but goes on after a problem where it can.</summary>
        /// <returns>The problems, none when the data is an index.</returns>
        /// <exception cref="GeodesicException">The check itself failed, for want of memory for example.</exception>
        public static IReadOnlyList<GeodesicIssue> Verify(ReadOnlySpan<byte> data)
        {
            var issues = new List<GeodesicIssue>();
            Verify(data, issue =>
            {
                issues.Add(issue);
                return true;
            });
            return issues;
        }

        /// <summary>Checks the bytes of a file as opening does, but goes on after a problem where it can.</summary>
        /// <param name="data">The bytes of a file.</param>
        /// <param name="visit">
        /// Is told each problem; false stops. What it throws is thrown on when the native library has returned.
        /// </param>
        /// <returns><see cref="GeodesicStatus.Ok"/>, or the status of the first problem.</returns>
        /// <exception cref="GeodesicException">The check itself failed, for want of memory for example.</exception>
        public static GeodesicStatus Verify(ReadOnlySpan<byte> data, Func<GeodesicIssue, bool> visit)
        {
            if (visit == null) throw new ArgumentNullException(nameof(visit));
            GeodesicLibrary.Load();
            using var callback = new IssueCallback(visit);
            GeodesicStatus status = Verify(data, callback);
            callback.Check(status);
            return status;
        }

        private NativeSaveOptions NativeOptions(GeodesicCodec? codec, bool? positions, bool mesh)
        {
            NativeSaveOptions native = NativeDefaults.SaveOptions();
            native.codec = (uint)(codec ?? Info.Codec);
            if (!(positions ?? Info.HasPositions)) native.flags |= (uint)SaveFlags.NoPositions;
            if (!mesh) native.flags |= (uint)SaveFlags.NoMesh;
            return native;
        }

        [MethodImpl(MethodImplOptions.NoInlining)]
        private static unsafe GeodesicStatus Verify(ReadOnlySpan<byte> data, IssueCallback callback)
        {
            using CallsInFlight.Call call = CallsInFlight.BeginCall();
            fixed (byte* bytes = &MemoryMarshal.GetReference(data))
                return NativeMethods.geoidx_verify(bytes, (ulong)data.Length, IssueCallback.Function, callback.User);
        }
    }
}
