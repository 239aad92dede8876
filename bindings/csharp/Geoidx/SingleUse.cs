using System;
using System.Threading;

namespace Geoidx
{
    /// <summary>Refuses what would corrupt a native object: two threads that use it at once.</summary>
    internal sealed class SingleUse
    {
        private int inUse;

        internal Scope Begin()
        {
            if (Interlocked.Exchange(ref inUse, 1) != 0)
                throw new InvalidOperationException("It is in use by another thread; each thread needs its own.");
            return new Scope(this);
        }

        internal readonly ref struct Scope
        {
            private readonly SingleUse use;

            internal Scope(SingleUse use) => this.use = use;

            public void Dispose() => Volatile.Write(ref use.inUse, 0);
        }
    }
}
