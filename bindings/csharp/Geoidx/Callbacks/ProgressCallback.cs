using System;
using System.Runtime.InteropServices;
using System.Threading;

namespace Geoidx
{
    internal sealed class ProgressCallback : UserCallback
    {
        private static readonly ProgressFunction Entry = OnProgress;

        private readonly IProgress<float>? progress;
        private readonly IProgress<BuildStage>? stages;
        private readonly CancellationToken cancellation;

        internal ProgressCallback(
            IProgress<float>? progress, IProgress<BuildStage>? stages, CancellationToken cancellation)
        {
            this.progress = progress;
            this.stages = stages;
            this.cancellation = cancellation;
        }

        internal static IntPtr Function => Marshal.GetFunctionPointerForDelegate(Entry);

        [UnmanagedFunctionPointer(CallingConvention.Cdecl)]
        private delegate int ProgressFunction(IntPtr user, float fraction, IntPtr stage);

        [MonoPInvokeCallback(typeof(ProgressFunction))]
        private static int OnProgress(IntPtr user, float fraction, IntPtr stage) =>
            !CallsInFlight.IsEnding && Of<ProgressCallback>(user).Report(fraction, stage) ? 1 : 0;

        private bool Report(float fraction, IntPtr stage)
        {
            using CallsInFlight.Callback scope = CallsInFlight.BeginCallback();
            try
            {
                progress?.Report(fraction);
                stages?.Report(new BuildStage(fraction, NativeText.FromUtf8(stage)));
                return !cancellation.IsCancellationRequested;
            }
            catch (Exception e)
            {
                Keep(e);
                return false;
            }
        }
    }
}
