using System;
using System.Runtime.InteropServices;

namespace Geoidx
{
    internal sealed class IssueCallback : UserCallback
    {
        private static readonly IssueFunction Entry = OnIssue;

        private readonly Func<GeodesicIssue, bool> visit;

        internal IssueCallback(Func<GeodesicIssue, bool> visit) => this.visit = visit;

        internal static IntPtr Function => Marshal.GetFunctionPointerForDelegate(Entry);

        [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
        private delegate int IssueFunction(IntPtr user, GeodesicStatus status, ulong offset, IntPtr message);

        [MonoPInvokeCallback(typeof(IssueFunction))]
        private static int OnIssue(IntPtr user, GeodesicStatus status, ulong offset, IntPtr message) =>
            Of<IssueCallback>(user).Visit(status, (long)offset, NativeText.FromUtf8(message)) ? 1 : 0;

        private bool Visit(GeodesicStatus status, long offset, string message)
        {
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
