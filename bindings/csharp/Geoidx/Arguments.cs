using System;

namespace Geoidx
{
    internal static class Arguments
    {
        internal static uint NotNegative(int value, string name) =>
            value >= 0 ? (uint)value : throw new ArgumentOutOfRangeException(name, value, "It must not be negative.");

        internal static ulong NotNegative(long value, string name) =>
            value >= 0 ? (ulong)value : throw new ArgumentOutOfRangeException(name, value, "It must not be negative.");
    }
}
