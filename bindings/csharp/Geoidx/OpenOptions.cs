namespace Geoidx
{
    /// <summary>Options for opening an index.</summary>
    public sealed class OpenOptions
    {
        /// <summary>
        /// The mesh that the index must have been built from: the same triangles, and positions that are equal as
        /// floats, whichever of the two was given in double precision. A file that was saved without positions needs it,
        /// and positions in the precision that the index was built with. Default: any.
        /// </summary>
        public GeodesicMesh? ExpectedMesh { get; set; }

        /// <summary>
        /// Makes what distances between two vertices need while the index is opened. Otherwise the first one that is
        /// asked for makes a part of it, and takes the memory for all, and later ones make the rest as they need it,
        /// which takes 1 to 15 ms each time for 40,000 vertices; where only fields are asked for, it is never made and takes no memory.
        /// Default: false.
        /// </summary>
        public bool Pairs { get; set; }

        /// <summary>
        /// Makes labels a part of what distances between two vertices need: the distances of each vertex to one or
        /// two borders that lie farther out. Without labels all of this takes a third of the memory and a tenth of the
        /// time to be made, and each distance between two vertices takes two to five times as long. It differs by
        /// 0.01 % on average, and by 1 to 3 % at most, on rough terrain by up to 5 %. Fields do not need labels and
        /// stay the same bits. An index that was just built has labels. Default: true.
        /// </summary>
        public bool Labels { get; set; } = true;

        /// <summary>Threads that decode tables. Default: 0, one per processor.</summary>
        public int Threads { get; set; }

        /// <summary>
        /// The most vertices, counted as <see cref="GeodesicInfo.VertexCount"/>, that an index may have; one with more
        /// is a <see cref="GeodesicLimitException"/>. Default: 0, any number.
        /// </summary>
        public long MaxVertices { get; set; }

        /// <summary>
        /// The most bytes that the decoded sections of the file may take, and the most that the index with its queries
        /// may; what needs more is a <see cref="GeodesicLimitException"/>. This holds as long as the index is open, so
        /// that a query can be refused, too. Default: 0, in proportion to the file.
        /// </summary>
        public long MaxMemory { get; set; }

        /// <summary>Where the index and its queries get memory. Default: the global heap.</summary>
        public IGeodesicAllocator? Allocator { get; set; }
    }
}
