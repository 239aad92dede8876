using System;

namespace Geoidx
{
    internal sealed unsafe class SolverHandle : OwnedHandle
    {
        private readonly BuildCallbacks callbacks;

        private SolverHandle(IntPtr solver, BuildCallbacks callbacks) : base(callbacks)
        {
            this.callbacks = callbacks;
            SetHandle(solver);
        }

        internal static SolverHandle Create(NativeMesh mesh, BuildOptions? options)
        {
            var callbacks = new BuildCallbacks(options);
            try
            {
                return new SolverHandle(Create(mesh, options, callbacks), callbacks);
            }
            catch
            {
                callbacks.Dispose();
                throw;
            }
        }

        /// <summary>Throws if the solver is disposed.</summary>
        internal void CheckOpen()
        {
            if (IsClosed) throw new ObjectDisposedException(nameof(GeodesicSolver));
        }

        /// <summary>Throws what the caller's metric threw, or what the status says.</summary>
        internal void Check(GeodesicStatus status)
        {
            if (status == GeodesicStatus.Ok) return;
            callbacks.Rethrow();
            throw status.ToException();
        }

        protected override void CloseNative() => NativeMethods.geoidx_solver_close(handle);

        private static IntPtr Create(NativeMesh mesh, BuildOptions? options, BuildCallbacks callbacks)
        {
            using CallsInFlight.Call call = CallsInFlight.BeginCall();
            using var pinned = new PinnedBuildOptions(options, callbacks);
            NativeBuildOptions native = pinned.Native;
            GeodesicStatus status = NativeMethods.geoidx_solver_create(&mesh, &native, out IntPtr solver);
            if (status == GeodesicStatus.Ok) return solver;
            callbacks.Rethrow();
            throw status.ToExceptionOfOptions();
        }
    }
}
