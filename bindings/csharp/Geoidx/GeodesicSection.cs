using System;

namespace Geoidx
{
    /// <summary>A section of the file that an index was opened from; format/SPEC.md says what is in it.</summary>
    public readonly struct GeodesicSection
    {
        internal unsafe GeodesicSection(NativeSection native)
        {
            Tag = NativeText.FromUtf8((IntPtr)native.tag);
            Coding = (SectionCoding)native.coding;
            Offset = (long)native.offset;
            StoredSize = (long)native.stored_size;
            RawSize = (long)native.raw_size;
        }

        /// <summary>Its name, four characters.</summary>
        public string Tag { get; }

        /// <summary>How its bytes are stored.</summary>
        public SectionCoding Coding { get; }

        /// <summary>Where it is, in bytes from the beginning of the file.</summary>
        public long Offset { get; }

        /// <summary>Its bytes in the file.</summary>
        public long StoredSize { get; }

        /// <summary>Its bytes when decoded.</summary>
        public long RawSize { get; }

        /// <summary>Name, coding, sizes and place.</summary>
        public override string ToString() => FormattableString.Invariant(
            $"{Tag}: {Coding}, {StoredSize} bytes at byte {Offset}, {RawSize} when decoded");
    }
}
