using System;
using System.Runtime.InteropServices;

namespace Geoidx
{
    internal sealed unsafe class MetricCallback : UserCallback
    {
        private static readonly MetricFunction Entry = OnMetric;

        private readonly GeodesicMetric metric;

        internal MetricCallback(GeodesicMetric metric) => this.metric = metric;

        internal static IntPtr Function => Marshal.GetFunctionPointerForDelegate(Entry);

        [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
        private delegate GeodesicStatus MetricFunction(
            IntPtr user, int source, int* targets, uint targetCount, double* distances);

        [MonoPInvokeCallback(typeof(MetricFunction))]
        private static GeodesicStatus OnMetric(
            IntPtr user, int source, int* targets, uint targetCount, double* distances) =>
            CallsInFlight.IsEnding
                ? GeodesicStatus.Callback
                : Of<MetricCallback>(user).Measure(source, targets, targetCount, distances);

        private GeodesicStatus Measure(int source, int* targets, uint targetCount, double* distances)
        {
            using CallsInFlight.Callback scope = CallsInFlight.BeginCallback();
            try
            {
                int count = checked((int)targetCount);
                metric(source, new ReadOnlySpan<int>(targets, count), new Span<double>(distances, count));
                return GeodesicStatus.Ok;
            }
            catch (Exception e)
            {
                Keep(e);
                return GeodesicStatus.Callback;
            }
        }
    }
}
