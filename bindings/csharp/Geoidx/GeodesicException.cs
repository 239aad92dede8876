using System;

namespace Geoidx
{
    /// <summary>
    /// A failed call. A cancelled build is not one of these but an <see cref="OperationCanceledException"/>.
    /// </summary>
    public class GeodesicException : Exception
    {
        internal GeodesicException(GeodesicStatus status, string detail) : base(detail) => Status = status;

        /// <summary>What failed. <see cref="Exception.Message"/> says where and with which value.</summary>
        public GeodesicStatus Status { get; }

        internal static Exception For(GeodesicStatus status, string detail)
        {
            switch (status)
            {
                case GeodesicStatus.InvalidArgument: return new GeodesicArgumentException(detail);
                case GeodesicStatus.IO: return new GeodesicIOException(detail);
                case GeodesicStatus.NotAnIndex:
                case GeodesicStatus.Truncated:
                case GeodesicStatus.Corrupt:
                case GeodesicStatus.Checksum: return new GeodesicDataException(status, detail);
                case GeodesicStatus.UnsupportedVersion: return new GeodesicVersionException(detail);
                case GeodesicStatus.MeshMismatch: return new GeodesicMeshMismatchException(detail);
                case GeodesicStatus.Limit: return new GeodesicLimitException(detail);
                case GeodesicStatus.OutOfMemory: return new GeodesicOutOfMemoryException(detail);
                case GeodesicStatus.Cancelled: return new OperationCanceledException(detail);
                case GeodesicStatus.BadMesh: return new GeodesicMeshException(detail);
                case GeodesicStatus.Callback: return new GeodesicMetricException(detail);
                default: return new GeodesicException(status, detail);
            }
        }
    }

    /// <summary>A vertex, an option or the length of a span is out of range.</summary>
    public sealed class GeodesicArgumentException : GeodesicException
    {
        internal GeodesicArgumentException(string detail) : base(GeodesicStatus.InvalidArgument, detail) { }
    }

    /// <summary>The operating system refused to open, read, write or rename a file.</summary>
    public sealed class GeodesicIOException : GeodesicException
    {
        internal GeodesicIOException(string detail) : base(GeodesicStatus.IO, detail) { }
    }

    /// <summary>
    /// The data is no index, or damaged: <see cref="GeodesicException.Status"/> is
    /// <see cref="GeodesicStatus.NotAnIndex"/>, <see cref="GeodesicStatus.Truncated"/>,
    /// <see cref="GeodesicStatus.Corrupt"/> or <see cref="GeodesicStatus.Checksum"/>.
    /// </summary>
    public sealed class GeodesicDataException : GeodesicException
    {
        internal GeodesicDataException(GeodesicStatus status, string detail) : base(status, detail) { }
    }

    /// <summary>The data was written by a newer format, or with features unknown here.</summary>
    public sealed class GeodesicVersionException : GeodesicException
    {
        internal GeodesicVersionException(string detail) : base(GeodesicStatus.UnsupportedVersion, detail) { }
    }

    /// <summary>The index was built from another mesh than the expected one.</summary>
    public sealed class GeodesicMeshMismatchException : GeodesicException
    {
        internal GeodesicMeshMismatchException(string detail) : base(GeodesicStatus.MeshMismatch, detail) { }
    }

    /// <summary>A count is over what the format, the library or <see cref="OpenOptions"/> allow.</summary>
    public sealed class GeodesicLimitException : GeodesicException
    {
        internal GeodesicLimitException(string detail) : base(GeodesicStatus.Limit, detail) { }
    }

    /// <summary>There was not enough native memory, or the caller's allocator gave none.</summary>
    public sealed class GeodesicOutOfMemoryException : GeodesicException
    {
        internal GeodesicOutOfMemoryException(string detail) : base(GeodesicStatus.OutOfMemory, detail) { }
    }

    /// <summary>The mesh cannot be used; the message names the vertex or triangle.</summary>
    public sealed class GeodesicMeshException : GeodesicException
    {
        internal GeodesicMeshException(string detail) : base(GeodesicStatus.BadMesh, detail) { }
    }

    /// <summary>The caller's metric gave NaN or a negative number. What it throws itself is thrown on.</summary>
    public sealed class GeodesicMetricException : GeodesicException
    {
        internal GeodesicMetricException(string detail) : base(GeodesicStatus.Callback, detail) { }
    }
}
