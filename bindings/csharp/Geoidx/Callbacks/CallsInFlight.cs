using System;
using System.Threading;

namespace Geoidx
{
    /// <summary>
    /// The native calls that call managed code back. A runtime that aborts its threads (Mono, when an AppDomain is
    /// unloaded or the program ends) would unwind such code through native frames; so before, the calls are ended:
    /// callbacks refuse to go on, and the runtime is kept waiting until the calls have returned.
    /// </summary>
    internal static class CallsInFlight
    {
        private static readonly TimeSpan Patience = TimeSpan.FromSeconds(10);
        private static readonly object Gate = new object();

        private static int calls;
        private static volatile bool isEnding;

        [ThreadStatic] private static int callbacksOfThisThread;

        static CallsInFlight()
        {
            AppDomain.CurrentDomain.DomainUnload += (_, _) => End();
            AppDomain.CurrentDomain.ProcessExit += (_, _) => End();
        }

        internal static bool IsEnding => isEnding;

        internal static int Count
        {
            get
            {
                lock (Gate) return calls;
            }
        }

        /// <summary>A native call, until the scope is left.</summary>
        /// <exception cref="OperationCanceledException">The AppDomain or the program ends.</exception>
        internal static Call BeginCall()
        {
            lock (Gate)
            {
                ThrowIfEnding();
                calls++;
            }
            return default;
        }

        /// <summary>The caller's code within a native call, until the scope is left.</summary>
        internal static Callback BeginCallback()
        {
            callbacksOfThisThread++;
            return default;
        }

        internal static void ThrowIfEnding()
        {
            if (isEnding) throw new OperationCanceledException("The program or its AppDomain ends.");
        }

        // A callback that ends the program itself is not waited for: its call cannot return before it does.
        private static void End()
        {
            isEnding = true;
            if (callbacksOfThisThread > 0) return;
            DateTime latest = DateTime.UtcNow + Patience;
            lock (Gate)
            {
                while (calls > 0 && latest - DateTime.UtcNow is { Ticks: > 0 } left) Monitor.Wait(Gate, left);
            }
        }

        private static void EndCall()
        {
            lock (Gate)
            {
                calls--;
                Monitor.PulseAll(Gate);
            }
        }

        internal readonly ref struct Call
        {
            public void Dispose() => EndCall();
        }

        internal readonly ref struct Callback
        {
            public void Dispose() => callbacksOfThisThread--;
        }
    }
}
