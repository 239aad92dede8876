using System.Linq;
using UnityEngine;

namespace Geoidx.Samples
{
    /// <summary>
    /// Colours the vertices of the mesh beside it by their distance along the surface from one of them. The material's
    /// shader must show vertex colours.
    /// </summary>
    [RequireComponent(typeof(MeshFilter))]
    public sealed class ColourByDistance : MonoBehaviour
    {
        /// <summary>The index of the mesh; none: it is built at the start, which takes seconds.</summary>
        public TextAsset? indexAsset;

        /// <summary>The vertex that distances are measured from.</summary>
        public int source;

        /// <summary>The colour of the source.</summary>
        public Color near = Color.red;

        /// <summary>The colour of the farthest vertex.</summary>
        public Color far = Color.blue;

        /// <summary>The colour of vertices that no path reaches.</summary>
        public Color unreachable = Color.grey;

        private GeodesicIndex? index;

        /// <summary>Measures from another vertex.</summary>
        public void MeasureFrom(int vertex)
        {
            source = vertex;
            float[] distances = index!.FromSources(source);
            float farthest = distances.Where(distance => !float.IsInfinity(distance)).Max();
            GetComponent<MeshFilter>().mesh.colors =
                distances.Select(distance => ColourAt(distance, farthest)).ToArray();
        }

        private void Start()
        {
            Mesh mesh = GetComponent<MeshFilter>().mesh;
            index = indexAsset != null ? indexAsset.OpenGeodesicIndex() : GeodesicIndex.Build(mesh.ToGeodesicMesh());
            MeasureFrom(source);
        }

        private void OnDestroy() => index?.Dispose();

        private Color ColourAt(float distance, float farthest) =>
            float.IsInfinity(distance) ? unreachable : Color.Lerp(near, far, farthest > 0 ? distance / farthest : 0);
    }
}
