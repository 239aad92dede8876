using System;
using UnityEngine;

namespace Geoidx
{
    /// <summary>Unity's meshes and assets as this library takes them.</summary>
    public static class UnityMeshes
    {
        /// <summary>
        /// The vertices and triangles of all submeshes, in the mesh's local unit. Vertices that only differ in normal
        /// or texture coordinates lie at one place and are one vertex to a path; each keeps its id.
        /// </summary>
        /// <exception cref="InvalidOperationException">The mesh is not readable by scripts.</exception>
        public static GeodesicMesh ToGeodesicMesh(this Mesh mesh)
        {
            if (mesh == null) throw new ArgumentNullException(nameof(mesh));
            if (!mesh.isReadable)
                throw new InvalidOperationException(
                    $"The mesh \"{mesh.name}\" is not readable: tick Read/Write in the import settings of its model.");
            return GeodesicMesh.From(mesh.vertices, mesh.triangles);
        }

        /// <summary>Opens an index that is an asset of the project, a file whose name ends in .bytes.</summary>
        /// <param name="asset">Made by Assets > Build Geodesic Index.</param>
        /// <param name="options">Null: the defaults.</param>
        /// <exception cref="GeodesicDataException">The asset is no index, or damaged.</exception>
        /// <exception cref="GeodesicMeshMismatchException">
        /// It belongs to another mesh than <see cref="OpenOptions.ExpectedMesh"/>.
        /// </exception>
        public static GeodesicIndex OpenGeodesicIndex(this TextAsset asset, OpenOptions? options = null)
        {
            if (asset == null) throw new ArgumentNullException(nameof(asset), "No asset is assigned.");
            return GeodesicIndex.Open(asset.bytes, options);
        }
    }
}
