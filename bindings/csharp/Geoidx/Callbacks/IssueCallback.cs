using System;
using System.Runtime.InteropServices;

namespace Geoidx
{
    internal sealed class IssueCallback : UserCallback
    {
        private static readonly unsafe IssueFunction Entry = OnIssue;

        private readonly Func<GeodesicIssue, bool> visit;
        private GeodesicStatus first = GeodesicStatus.Ok;

        internal IssueCallback(Func<GeodesicIssue, bool> visit) => this.visit = visit;

        internal static IntPtr Function => Marshal.GetFunctionPointerForDelegate(Entry);

        [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
        private unsafe delegate int IssueFunction(IntPtr user, NativeIssue* issue);

        [MonoPInvokeCallback(typeof(IssueFunction))]
        private static unsafe int OnIssue(IntPtr user, NativeIssue* issue) =>
            !CallsInFlight.IsEnding && Of<IssueCallback>(user).Visit(Copy(*issue)) ? 1 : 0;

        private static GeodesicIssue Copy(in NativeIssue issue) =>
            new GeodesicIssue(
                (GeodesicIssueNumber)issue.number,
                (GeodesicStatus)issue.status,
                (long)issue.offset,
                NativeText.FromUtf8(issue.message));

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

        private bool Visit(GeodesicIssue issue)
        {
            if (first == GeodesicStatus.Ok) first = issue.Status;
            using CallsInFlight.Callback scope = CallsInFlight.BeginCallback();
            try
            {
                return visit(issue);
            }
            catch (Exception e)
            {
                Keep(e);
                return false;
            }
        }
    }
}
