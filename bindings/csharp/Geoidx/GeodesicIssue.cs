namespace Geoidx
{
    /// <summary>A problem found in the data of an index.</summary>
    public readonly struct GeodesicIssue
    {
        internal GeodesicIssue(GeodesicStatus status, long offset, string message)
        {
            Status = status;
            Offset = offset;
            Message = message;
        }

        /// <summary>The kind of problem.</summary>
        public GeodesicStatus Status { get; }

        /// <summary>Where it is, in bytes from the beginning of the data.</summary>
        public long Offset { get; }

        /// <summary>The problem in one line.</summary>
        public string Message { get; }

        /// <summary>Kind, place and problem.</summary>
        public override string ToString() => $"{Status} at byte {Offset}: {Message}";
    }
}
