using System;
using System.Runtime.InteropServices;

namespace Geoidx
{
    /// <summary>A native object, and what must live as long as it does.</summary>
    internal abstract class OwnedHandle : SafeHandle
    {
        private readonly IDisposable? companion;

        protected OwnedHandle(IDisposable? companion) : base(IntPtr.Zero, true) => this.companion = companion;

        public override bool IsInvalid => handle == IntPtr.Zero;

        protected abstract void CloseNative();

        protected sealed override bool ReleaseHandle()
        {
            CloseNative();
            companion?.Dispose();
            return true;
        }
    }
}
