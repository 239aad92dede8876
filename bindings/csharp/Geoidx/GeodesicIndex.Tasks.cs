using System;
using System.Threading;
using System.Threading.Tasks;

namespace Geoidx
{
    public sealed partial class GeodesicIndex
    {
        /// <summary>Builds the index of a mesh on a thread of the pool.</summary>
        /// <inheritdoc cref="Build(GeodesicMesh, BuildOptions?, IProgress{float}?, CancellationToken)"/>
        public static Task<GeodesicIndex> BuildAsync(
            GeodesicMesh mesh,
            BuildOptions? options = null,
            IProgress<float>? progress = null,
            CancellationToken cancellationToken = default) =>
            Task.Run(() => Build(mesh, options, progress, cancellationToken), cancellationToken);

        /// <summary>Opens an index from a file on a thread of the pool; once begun, this is not cancelled.</summary>
        /// <inheritdoc cref="Open(string, OpenOptions?)"/>
        public static Task<GeodesicIndex> OpenAsync(
            string path, OpenOptions? options = null, CancellationToken cancellationToken = default) =>
            Task.Run(() => Open(path, options), cancellationToken);

        /// <summary>
        /// Writes the index to a file, as <see cref="Save(string, GeodesicCodec?, bool?, bool)"/> does, on a thread of the
        /// pool; once begun, this is not cancelled.
        /// </summary>
        public Task SaveAsync(
            string path,
            GeodesicCodec? codec = null,
            bool? positions = null,
            bool mesh = true,
            CancellationToken cancellationToken = default) =>
            Task.Run(() => Save(path, codec, positions, mesh), cancellationToken);
    }
}
