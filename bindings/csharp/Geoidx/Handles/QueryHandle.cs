using System;

namespace Geoidx
{
    /// <summary>Scratch for queries, which keeps its index open.</summary>
    internal sealed class QueryHandle : OwnedHandle
    {
        private QueryHandle(IntPtr query, IndexLease lease) : base(lease) => SetHandle(query);

        internal static QueryHandle Create(IndexHandle index)
        {
            var lease = new IndexLease(index);
            GeodesicStatus status = NativeMethods.geoidx_query_create(index, out IntPtr query);
            if (status == GeodesicStatus.Ok) return new QueryHandle(query, lease);
            lease.Dispose();
            throw status.ToException();
        }

        protected override void CloseNative() => NativeMethods.geoidx_query_close(handle);

        private sealed class IndexLease : IDisposable
        {
            private readonly IndexHandle index;

            internal IndexLease(IndexHandle index)
            {
                bool isTaken = false;
                index.DangerousAddRef(ref isTaken);
                this.index = index;
            }

            public void Dispose() => index.DangerousRelease();
        }
    }
}
