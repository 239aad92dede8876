using System;

namespace Geoidx
{
    /// <summary>
    /// Native memory of the caller's choosing, for an index and its queries. Its methods are called from several
    /// threads at once, the finalizer's among them, until the index and its queries are disposed; they must not use
    /// this library. An index and its queries hold their allocator: an index that it can reach is not collected before
    /// it is disposed.
    /// </summary>
    public interface IGeodesicAllocator
    {
        /// <summary>
        /// Memory of <paramref name="size"/> bytes, aligned to <paramref name="alignment"/> (a power of two, at most
        /// 64), or zero when there is none; an exception counts as zero.
        /// </summary>
        IntPtr Allocate(ulong size, ulong alignment);

        /// <summary>Takes back what <see cref="Allocate"/> gave for the same size and alignment.</summary>
        void Release(IntPtr memory, ulong size, ulong alignment);
    }
}
