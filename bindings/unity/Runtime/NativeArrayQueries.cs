using System;
using Unity.Collections;
using Unity.Collections.LowLevel.Unsafe;

namespace Geoidx
{
    /// <summary>
    /// Queries that read and write native arrays, as jobs have them, without a copy. They do what the methods of the
    /// same name do that take spans.
    /// </summary>
    public static class NativeArrayQueries
    {
        /// <summary>The distance of each pair, in the mesh's unit; many at once take less time each.</summary>
        public static void Distances(
            this GeodesicIndex index, NativeArray<VertexPair> pairs, NativeArray<float> distances) =>
            index.Distances(Read(pairs), Written(distances));

        /// <summary>The distance of every vertex to the nearest source (MSAD), in the mesh's unit.</summary>
        public static void FromSources(
            this GeodesicIndex index, NativeArray<int> sources, NativeArray<float> distances) =>
            index.FromSources(Read(sources), Written(distances));

        /// <summary>
        /// The distances from each source to every vertex, in the mesh's unit: that from sources[i] to v at
        /// i * VertexCount + v.
        /// </summary>
        public static void FromEachSource(
            this GeodesicIndex index, NativeArray<int> sources, NativeArray<float> distances) =>
            index.FromEachSource(Read(sources), Written(distances));

        /// <summary>
        /// The distance from every source to every target, in the mesh's unit: that from sources[i] to targets[j] at
        /// i * targets.Length + j.
        /// </summary>
        public static void Matrix(
            this GeodesicIndex index, NativeArray<int> sources, NativeArray<int> targets,
            NativeArray<float> distances) =>
            index.Matrix(Read(sources), Read(targets), Written(distances));

        /// <summary>The distance of every vertex to the nearest source (MSAD), in the mesh's unit.</summary>
        public static void FromSources(
            this GeodesicQuery query, NativeArray<int> sources, NativeArray<float> distances) =>
            query.FromSources(Read(sources), Written(distances));

        /// <summary>
        /// The distance of every vertex to the nearest source (MSAD), in the mesh's unit, infinite beyond a radius.
        /// </summary>
        public static void FromSourcesWithin(
            this GeodesicQuery query, NativeArray<int> sources, float radius, NativeArray<float> distances) =>
            query.FromSourcesWithin(Read(sources), radius, Written(distances));

        /// <summary>
        /// The distances from each source to every vertex, in the mesh's unit: that from sources[i] to v at
        /// i * VertexCount + v.
        /// </summary>
        public static void FromEachSource(
            this GeodesicQuery query, NativeArray<int> sources, NativeArray<float> distances) =>
            query.FromEachSource(Read(sources), Written(distances));

        /// <summary>
        /// The distance from every source to every target, in the mesh's unit: that from sources[i] to targets[j] at
        /// i * targets.Length + j.
        /// </summary>
        public static void Matrix(
            this GeodesicQuery query, NativeArray<int> sources, NativeArray<int> targets,
            NativeArray<float> distances) =>
            query.Matrix(Read(sources), Read(targets), Written(distances));

        /// <summary>The nearest source to every vertex, and how far it is, in the mesh's unit.</summary>
        public static void NearestSources(
            this GeodesicQuery query, NativeArray<int> sources, NativeArray<int> nearest,
            NativeArray<float> distances = default) =>
            query.NearestSources(Read(sources), Written(nearest), Written(distances));

        /// <summary>
        /// The vertices that are no farther than a radius from the nearest source, the nearest first, and how far they
        /// are, in the mesh's unit.
        /// </summary>
        /// <returns>How many vertices are within the radius, which may be more than there is room for.</returns>
        public static int Within(
            this GeodesicQuery query, NativeArray<int> sources, float radius, NativeArray<int> vertices,
            NativeArray<float> distances = default) =>
            query.Within(Read(sources), radius, Written(vertices), Written(distances));

        /// <summary>
        /// The positions of the nearest of some targets, the nearest first, and how far they are, in the mesh's unit.
        /// </summary>
        /// <returns>
        /// How many targets there are: fewer than there is room for only if no more of them can be reached.
        /// </returns>
        public static int NearestTargets(
            this GeodesicQuery query, int source, NativeArray<int> targets, NativeArray<int> positions,
            NativeArray<float> distances = default) =>
            query.NearestTargets(source, Read(targets), Written(positions), Written(distances));

        /// <summary>
        /// Points that are far from each other, and how far each is from the sources and from the points before it, in
        /// the mesh's unit.
        /// </summary>
        /// <returns>How many points there are: fewer than there is room for only on a small mesh.</returns>
        public static int FarthestPoints(
            this GeodesicQuery query, NativeArray<int> sources, NativeArray<int> points,
            NativeArray<float> distances = default) =>
            query.FarthestPoints(Read(sources), Written(points), Written(distances));

        /// <summary>The distances from the prepared source to targets, in the mesh's unit.</summary>
        public static void FromPrepared(
            this GeodesicQuery query, NativeArray<int> targets, NativeArray<float> distances) =>
            query.FromPrepared(Read(targets), Written(distances));

        private static unsafe ReadOnlySpan<T> Read<T>(NativeArray<T> array) where T : unmanaged =>
            new ReadOnlySpan<T>(array.GetUnsafeReadOnlyPtr(), array.Length);

        private static unsafe Span<T> Written<T>(NativeArray<T> array) where T : unmanaged =>
            array.IsCreated ? new Span<T>(array.GetUnsafePtr(), array.Length) : default;
    }
}
