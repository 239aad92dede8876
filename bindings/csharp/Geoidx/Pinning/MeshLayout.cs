namespace Geoidx
{
    /// <summary>How the elements of an array are the positions of vertices.</summary>
    internal readonly unsafe struct MeshLayout
    {
        private readonly PositionType type;
        private readonly int stride;
        private readonly int elementsPerVertex;

        private MeshLayout(PositionType type, int stride, int elementsPerVertex)
        {
            this.type = type;
            this.stride = stride;
            this.elementsPerVertex = elementsPerVertex;
        }

        internal static MeshLayout Of<TVertex>(PositionType type) where TVertex : unmanaged
        {
            if (typeof(TVertex) == typeof(float)) return new MeshLayout(PositionType.Float, 0, 3);
            if (typeof(TVertex) == typeof(double)) return new MeshLayout(PositionType.Double, 0, 3);
            int needed = 3 * (type == PositionType.Double ? sizeof(double) : sizeof(float));
            if (sizeof(TVertex) >= needed) return new MeshLayout(type, sizeof(TVertex), 1);
            throw new GeodesicArgumentException(
                $"{typeof(TVertex)} has {sizeof(TVertex)} bytes, a position needs {needed}.");
        }

        internal NativeMesh Describe(int elements, int corners)
        {
            if (elements % elementsPerVertex != 0)
                throw new GeodesicArgumentException($"{elements} coordinates are not three a vertex.");
            if (corners % 3 != 0)
                throw new GeodesicArgumentException($"{corners} indices are not three a triangle.");
            NativeMesh mesh = NativeDefaults.Mesh();
            mesh.position_type = (uint)type;
            mesh.position_stride = (uint)stride;
            mesh.vertex_count = (ulong)(elements / elementsPerVertex);
            mesh.triangle_count = (ulong)(corners / 3);
            return mesh;
        }
    }
}
