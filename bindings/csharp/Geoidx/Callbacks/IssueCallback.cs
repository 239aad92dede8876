using System;
using System.Runtime.InteropServices;

namespace Geoidx
{
    internal sealed class IssueCallback : UserCallback
    {
        private static readonly IssueFunction Entry = OnIssue;

        private readonly Func<GeodesicIssue, bool> visit;
        private GeodesicStatus first = GeodesicStatus.Ok;

        internal IssueCallback(Func<GeodesicIssue, bool> visit) => this.visit = visit;

        internal static IntPtr Function => Marshal.GetFunctionPointerForDelegate(Entry);

        [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
        private delegate int IssueFunction(IntPtr user, GeodesicStatus status, ulong offset, IntPtr message);

        [MonoPInvokeCallback(typeof(IssueFunction))]
        private static int OnIssue(IntPtr user, GeodesicStatus status, ulong offset, IntPtr message) =>
            !CallsInFlight.IsEnding &&
            Of<IssueCallback>(user).Visit(status, (long)offset, NativeText.FromUtf8(message))
                ? 1
                : 0;

        /// <summary>
        /// Throws what the visitor threw, or what the status says, unless it is that of the first problem.
        /// </summary>
        internal void Check(GeodesicStatus status)
        {
            Rethrow();
            if (status == first) return;
            CallsInFlight.ThrowIfEnding();
            throw status.ToException();
        }

        private bool Visit(GeodesicStatus status, long offset, string message)
        {
            if (first == GeodesicStatus.Ok) first = status;
            using CallsInFlight.Callback scope = CallsInFlight.BeginCallback();
            try
            {
                return visit(new GeodesicIssue(status, offset, message));
            }
            catch (Exception e)
            {
                Keep(e);
                return false;
            }
        }
    }
}
