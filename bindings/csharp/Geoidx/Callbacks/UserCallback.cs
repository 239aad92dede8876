using System;
using System.Runtime.ExceptionServices;
using System.Runtime.InteropServices;
using System.Threading;

namespace Geoidx
{
    /// <summary>
    /// What a native callback needs to find its managed object again, and to keep the first exception until the
    /// native frames are left.
    /// </summary>
    internal abstract class UserCallback : IDisposable
    {
        private GCHandle self;
        private ExceptionDispatchInfo? failure;

        protected UserCallback() => self = GCHandle.Alloc(this);

        /// <summary>The `user` argument of the native callback.</summary>
        internal IntPtr User => GCHandle.ToIntPtr(self);

        public void Dispose() => self.Free();

        /// <summary>Throws on what the callback threw since the last time, if anything.</summary>
        internal void Rethrow() => Interlocked.Exchange(ref failure, null)?.Throw();

        protected void Keep(Exception exception) =>
            Interlocked.CompareExchange(ref failure, ExceptionDispatchInfo.Capture(exception), null);

        protected static T Of<T>(IntPtr user) where T : UserCallback => (T)GCHandle.FromIntPtr(user).Target!;
    }
}
