using System;
using UnityEngine;

namespace Geoidx.Samples
{
    /// <summary>
    /// Walks along the surface of a mesh to a place on it, in a way that is little longer than the shortest.
    /// </summary>
    public sealed class WalkAlongSurface : MonoBehaviour
    {
        /// <summary>The mesh to walk on, which must be readable.</summary>
        public MeshFilter? ground;

        /// <summary>The index of that mesh; none: it is built at the start, which takes seconds.</summary>
        public TextAsset? indexAsset;

        /// <summary>Where the walk leads to from the start; none: it waits for <see cref="WalkTo"/>.</summary>
        public Transform? target;

        /// <summary>The way in a second, in the mesh's local unit.</summary>
        public float speed = 1;

        private GeodesicIndex? index;
        private GeodesicSurface? surface;
        private GeodesicQuery? query;
        private SurfacePoint place;
        private bool hasTarget;

        /// <summary>Walks to the point of the surface that is nearest to a position in the world.</summary>
        public void WalkTo(Vector3 position)
        {
            query!.PrepareTarget(surface!, Below(position));
            hasTarget = true;
        }

        private void Start()
        {
            GeodesicMesh mesh = ground!.sharedMesh.ToGeodesicMesh();
            index = indexAsset != null ? indexAsset.OpenGeodesicIndex() : GeodesicIndex.Build(mesh);
            surface = new GeodesicSurface(mesh);
            query = index.CreateQuery();
            place = Below(transform.position);
            if (target != null) WalkTo(target.position);
        }

        private void Update()
        {
            if (hasTarget) Advance(speed * Time.deltaTime);
        }

        private void OnDestroy()
        {
            query?.Dispose();
            surface?.Dispose();
            index?.Dispose();
        }

        // A frame's way may lead over several triangles, and end within one. At the target a step has no length.
        private void Advance(double way)
        {
            while (way > 0 && query!.TryNextStep(surface!, place, out PathPoint start, out PathPoint end, out _))
            {
                double length = Length(start, end), share = length > way ? way / length : 1;
                place = share < 1 ? Between(start.Point, end.Point, share) : end.Point;
                transform.position = ground!.transform.TransformPoint(new Vector3(
                    (float)Between(start.X, end.X, share),
                    (float)Between(start.Y, end.Y, share),
                    (float)Between(start.Z, end.Z, share)));
                way = length > 0 ? way - length : 0;
            }
        }

        private SurfacePoint Below(Vector3 position)
        {
            Vector3 local = ground!.transform.InverseTransformPoint(position);
            return surface!.ClosestPoint(local.x, local.y, local.z);
        }

        private static double Length(PathPoint a, PathPoint b) =>
            Math.Sqrt(Math.Pow(b.X - a.X, 2) + Math.Pow(b.Y - a.Y, 2) + Math.Pow(b.Z - a.Z, 2));

        // Both points of a step have weights of the same triangle.
        private static SurfacePoint Between(SurfacePoint a, SurfacePoint b, double share) =>
            new SurfacePoint(
                a.Triangle,
                Between(a.Weight0, b.Weight0, share),
                Between(a.Weight1, b.Weight1, share),
                Between(a.Weight2, b.Weight2, share));

        private static double Between(double a, double b, double share) => (1 - share) * a + share * b;
    }
}
