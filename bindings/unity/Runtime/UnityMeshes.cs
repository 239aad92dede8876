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
        public static GeodesicMesh ToGeodesicMesh(this Mesh mesh) => GeodesicMesh.From(mesh.vertices, mesh.triangles);

        /// <summary>Opens an index that is an asset of the project, a file whose name ends in .bytes.</summary>
        /// <exception cref="GeodesicDataException">The asset is no index, or damaged.</exception>
        public static GeodesicIndex OpenGeodesicIndex(this TextAsset asset) => GeodesicIndex.Open(asset.bytes);
    }
}
