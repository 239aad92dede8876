using System;
using System.Threading;

namespace Geoidx
{
    /// <summary>The caller's code that a build or a solver calls.</summary>
    internal sealed class BuildCallbacks : IDisposable
    {
        private readonly MetricCallback? metric;
        private readonly ProgressCallback progress;
        private readonly CancellationToken cancellation;

        internal BuildCallbacks(
            BuildOptions? options, IProgress<float>? progress = null, CancellationToken cancellation = default)
        {
            this.cancellation = cancellation;
            this.progress = new ProgressCallback(progress, options?.StageProgress, cancellation);
            if (options?.MetricCallback is { } callback) metric = new MetricCallback(callback);
        }

        // Progress is asked for by every build, so that each can be ended with its AppDomain.
        internal void Register(ref NativeBuildOptions native)
        {
            if (metric != null)
            {
                native.metric_callback = MetricCallback.Function;
                native.metric_user = metric.User;
            }
            native.progress = ProgressCallback.Function;
            native.progress_user = progress.User;
        }

        /// <summary>After a failure: throws what the caller's code threw, or that it cancelled, if it did.</summary>
        internal void Rethrow()
        {
            progress.Rethrow();
            metric?.Rethrow();
            cancellation.ThrowIfCancellationRequested();
            CallsInFlight.ThrowIfEnding();
        }

        public void Dispose()
        {
            progress.Dispose();
            metric?.Dispose();
        }
    }
}
