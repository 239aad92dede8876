namespace Geoidx
{
    /// <summary>A problem found in the data of an index.</summary>
    public readonly struct GeodesicIssue
    {
        internal GeodesicIssue(GeodesicIssueNumber number, GeodesicStatus status, long offset, string message)
        {
            Number = number;
            Status = status;
            Offset = offset;
            Message = message;
        }

        /// <summary>The rule that is broken, by a number that stays the same.</summary>
        public GeodesicIssueNumber Number { get; }

        /// <summary>The kind of problem.</summary>
        public GeodesicStatus Status { get; }

        /// <summary>
        /// Where it is, in bytes from the beginning of the data. Of a section's content it is where the section's
        /// bytes begin.
        /// </summary>
        public long Offset { get; }

        /// <summary>The problem in one line.</summary>
        public string Message { get; }

        /// <summary>Number, kind, place and problem.</summary>
        public override string ToString() => $"issue {(int)Number}, {Status} at byte {Offset}: {Message}";
    }
}
