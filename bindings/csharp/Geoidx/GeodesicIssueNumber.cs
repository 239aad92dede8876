namespace Geoidx
{
    /// <summary>
    /// Which rule of the file format is broken. A number never changes its meaning; newer libraries may have others.
    /// </summary>
    public enum GeodesicIssueNumber
    {
        /// <summary>The data does not begin like an index.</summary>
        Magic = 1,

        /// <summary>The data ends within the header.</summary>
        HeaderTruncated = 2,

        /// <summary>Another major version of the format.</summary>
        Version = 3,

        /// <summary>An incompatible feature flag that is unknown here.</summary>
        FeatureFlags = 4,

        /// <summary>Shorter than the file size in the header.</summary>
        FileTruncated = 5,

        /// <summary>Longer than the file size in the header.</summary>
        FileTooLong = 6,

        /// <summary>More sections than the format allows.</summary>
        SectionCount = 7,

        /// <summary>The section table does not fit into the file.</summary>
        SectionTable = 8,

        /// <summary>A section is not inside the file.</summary>
        SectionOutside = 9,

        /// <summary>A section does not stand right behind the one before it.</summary>
        SectionPlace = 10,

        /// <summary>Two sections have one tag.</summary>
        SectionTwice = 11,

        /// <summary>An undefined flag of a section, or its reserved field is not 0.</summary>
        SectionFlags = 12,

        /// <summary>A section that is needed and unknown here.</summary>
        SectionUnknown = 13,

        /// <summary>A section with a codec that is unknown here.</summary>
        SectionCodec = 14,

        /// <summary>A raw size that the stored bytes of a section cannot hold.</summary>
        SectionSize = 15,

        /// <summary>The file does not end with the last section.</summary>
        FileEnd = 16,

        /// <summary>The checksum of header and section table does not match.</summary>
        HeaderChecksum = 17,

        /// <summary>A byte between sections is not 0.</summary>
        Padding = 18,

        /// <summary>The checksum of a section does not match.</summary>
        SectionChecksum = 19,

        /// <summary>The stored bytes of a section are not what its codec makes.</summary>
        Decoding = 100,

        /// <summary>The content of section META: what the mesh and the options were.</summary>
        Meta = 101,

        /// <summary>The content of section HIER: the hierarchy of patches.</summary>
        Hier = 102,

        /// <summary>The content of section VERT: the vertex of every id.</summary>
        Vert = 103,

        /// <summary>The content of section POSI: positions.</summary>
        Posi = 104,

        /// <summary>The content of section BORD: borders.</summary>
        Bord = 105,

        /// <summary>The content of section BVBV: border tables.</summary>
        Bvbv = 106,

        /// <summary>The content of section BVIV: border-internal tables.</summary>
        Bviv = 107,

        /// <summary>The content of section IVIV: internal tables.</summary>
        Iviv = 108,

        /// <summary>The content of section QUAN: quanta.</summary>
        Quan = 109,

        /// <summary>The content of section SEGM: border segments.</summary>
        Segm = 110,

        /// <summary>The content of section OVOV: overlay tables.</summary>
        Ovov = 111,

        /// <summary>The content of section HOPS: the tables of a mapped file.</summary>
        Hops = 112,

        /// <summary>The content of section MESH: the mesh that the index keeps.</summary>
        Mesh = 113,

        /// <summary>The content of section PAIR: measured pairs.</summary>
        Pair = 114,

        /// <summary>The content of section EDGE: edges along which fields are lowered.</summary>
        Edge = 115,

        /// <summary>No single section is at fault: the index is over a limit, or out of proportion to its file.</summary>
        WholeIndex = 200,
    }
}
