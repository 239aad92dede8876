using System;
using System.IO;
using System.Linq;
using System.Threading.Tasks;
using Xunit;

namespace Geoidx.Tests
{
    /// <summary>The forms of files, and what they are made of.</summary>
    public sealed class CodecTests : IDisposable
    {
        private const int Side = 24;
        private static readonly string[] Tables = { "OVOV", "BVIV", "IVIV" };

        private readonly GeodesicIndex built = GeodesicIndex.Build(Shapes.Plane(Side));

        public void Dispose() => built.Dispose();

        [Theory]
        [InlineData(GeodesicCodec.Packed)]
        [InlineData(GeodesicCodec.Lossless)]
        [InlineData(GeodesicCodec.Mapped)]
        public void AFileOfAnyCodecAnswersTheSameBits(GeodesicCodec codec)
        {
            byte[] bytes = built.ToBytes(codec);
            using GeodesicIndex opened = GeodesicIndex.Open(bytes);
            Assert.Equal(codec, opened.Info.Codec);
            AnswersAsBuilt(opened);
            Assert.Equal(bytes, opened.ToBytes());
            Assert.Equal(built.ToBytes(GeodesicCodec.Packed), opened.ToBytes(GeodesicCodec.Packed));
            Assert.Equal(built.ToBytes(GeodesicCodec.Lossless), opened.ToBytes(GeodesicCodec.Lossless));
            Assert.Equal(built.ToBytes(GeodesicCodec.Mapped), opened.ToBytes(GeodesicCodec.Mapped));
            Assert.Empty(GeodesicIndex.Verify(bytes));
        }

        [Fact]
        public void WhatIsBuiltIsPackedByDefault()
        {
            Assert.Equal(GeodesicCodec.Packed, built.Info.Codec);
            Assert.Equal(built.ToBytes(GeodesicCodec.Packed), built.ToBytes());
            Assert.True(2 * built.ToBytes().Length < built.ToBytes(GeodesicCodec.Lossless).Length);
        }

        [Fact]
        public void AGraphIsAlwaysLossless()
        {
            using GeodesicIndex graph = GeodesicIndex.Build(
                Shapes.Plane(9), new BuildOptions { Engine = GeodesicEngine.Graph });
            Assert.Equal(GeodesicCodec.Lossless, graph.Info.Codec);
            Assert.Equal(graph.ToBytes(GeodesicCodec.Lossless), graph.ToBytes(GeodesicCodec.Packed));
            Assert.Equal(graph.ToBytes(GeodesicCodec.Lossless), graph.ToBytes(GeodesicCodec.Mapped));
            Assert.Equal((0.0, 0.0), (graph.Info.SmallestStep, graph.Info.LargestStep));
        }

        [Theory]
        [InlineData(GeodesicCodec.Packed)]
        [InlineData(GeodesicCodec.Lossless)]
        [InlineData(GeodesicCodec.Mapped)]
        public async Task FilesAndStreamsTakeACodec(GeodesicCodec codec)
        {
            byte[] expected = built.ToBytes(codec);
            using var stream = new MemoryStream();
            built.Save(stream, codec);
            Assert.Equal(expected, stream.ToArray());
            stream.Position = 0;
            using (GeodesicIndex opened = GeodesicIndex.Open(stream)) AnswersAsBuilt(opened);
            string path = Path.GetTempFileName();
            try
            {
                built.Save(path, codec);
                Assert.Equal(expected, File.ReadAllBytes(path));
                File.WriteAllBytes(path, new byte[1]);
                await built.SaveAsync(path, codec);
                Assert.Equal(expected, File.ReadAllBytes(path));
                using GeodesicIndex opened = GeodesicIndex.Open(path);
                AnswersAsBuilt(opened);
            }
            finally
            {
                File.Delete(path);
            }
        }

        [Theory]
        [InlineData(GeodesicCodec.Packed)]
        [InlineData(GeodesicCodec.Lossless)]
        [InlineData(GeodesicCodec.Mapped)]
        public async Task AFileWithoutPositionsOpensWithTheMesh(GeodesicCodec codec)
        {
            byte[] bytes = built.ToBytes(codec, positions: false);
            Assert.True(built.Info.HasPositions);
            Assert.True(bytes.Length < built.ToBytes(codec).Length);
            var options = new OpenOptions { ExpectedMesh = Shapes.Plane(Side) };
            using GeodesicIndex opened = GeodesicIndex.Open(bytes, options);
            Assert.False(opened.Info.HasPositions);
            AnswersAsBuilt(opened);
            Assert.Equal(bytes, opened.ToBytes());
            Assert.Equal(built.ToBytes(codec), opened.ToBytes(positions: true));
            Assert.Equal(built.ToBytes(GeodesicCodec.Packed, false), opened.ToBytes(GeodesicCodec.Packed));
            Assert.Empty(GeodesicIndex.Verify(bytes));
            using var stream = new MemoryStream();
            built.Save(stream, codec, false);
            Assert.Equal(bytes, stream.ToArray());
            string path = Path.GetTempFileName();
            try
            {
                await built.SaveAsync(path, codec, false);
                Assert.Equal(bytes, File.ReadAllBytes(path));
                built.Save(path, codec, true);
                Assert.Equal(built.ToBytes(codec), File.ReadAllBytes(path));
            }
            finally
            {
                File.Delete(path);
            }
        }

        [Fact]
        public void AFileWithoutPositionsDoesNotOpenWithoutTheMesh()
        {
            byte[] bytes = built.ToBytes(positions: false);
            GeodesicArgumentException none =
                Assert.Throws<GeodesicArgumentException>(() => GeodesicIndex.Open(bytes));
            Assert.Contains(nameof(OpenOptions.ExpectedMesh), none.Message);
            var options = new OpenOptions { ExpectedMesh = Shapes.Plane(Side + 1) };
            Assert.Throws<GeodesicMeshMismatchException>(() => GeodesicIndex.Open(bytes, options));
        }

        [Fact]
        public void BytesOfAMappedFileAreNotNeededAfterwards()
        {
            byte[] bytes = built.ToBytes(GeodesicCodec.Mapped);
            using GeodesicIndex opened = GeodesicIndex.Open(bytes);
            Array.Clear(bytes, 0, bytes.Length);
            AnswersAsBuilt(opened);
        }

        [Fact]
        public void TablesOfAMappedFileTakeNoMemoryOfTheIndex()
        {
            byte[] bytes = built.ToBytes(GeodesicCodec.Mapped);
            var copying = new CountingAllocator();
            var mapping = new CountingAllocator();
            string path = Path.GetTempFileName();
            try
            {
                File.WriteAllBytes(path, bytes);
                using GeodesicIndex copied = GeodesicIndex.Open(bytes, new OpenOptions { Allocator = copying });
                using GeodesicIndex mapped = GeodesicIndex.Open(path, new OpenOptions { Allocator = mapping });
                Assert.InRange(mapping.Bytes, 1, copying.Bytes - bytes.Length);
            }
            finally
            {
                File.Delete(path);
            }
        }

        [Fact]
        public void AMappedFileHasItsTablesAsTheyAre()
        {
            using GeodesicIndex opened = GeodesicIndex.Open(built.ToBytes(GeodesicCodec.Mapped));
            GeodesicSection tables = Assert.Single(opened.Sections, section => section.Tag == "HOPS");
            Assert.Equal(SectionCoding.Raw, tables.Coding);
            Assert.Equal(tables.RawSize, tables.StoredSize);
            Assert.DoesNotContain(opened.Sections, section => Tables.Contains(section.Tag));
        }

        [Theory]
        [InlineData(GeodesicCodec.Packed, SectionCoding.Images)]
        [InlineData(GeodesicCodec.Lossless, SectionCoding.Png)]
        public void SectionsAreThoseOfTheFile(GeodesicCodec codec, SectionCoding codingOfTables)
        {
            byte[] bytes = built.ToBytes(codec);
            GeodesicIndex opened = GeodesicIndex.Open(bytes);
            opened.Dispose();
            Assert.Equal("META", opened.Sections[0].Tag);
            Assert.All(opened.Sections, section => Assert.InRange(section.Offset, 1, bytes.Length));
            Assert.All(opened.Sections, section => Assert.InRange(section.StoredSize, 1, bytes.Length));
            GeodesicSection last = opened.Sections[opened.Sections.Count - 1];
            Assert.Equal(bytes.Length, last.Offset + last.StoredSize);
            GeodesicSection[] tables = opened.Sections.Where(section => Tables.Contains(section.Tag)).ToArray();
            Assert.Equal(Tables, tables.Select(section => section.Tag));
            Assert.All(tables, section => Assert.Equal(codingOfTables, section.Coding));
            Assert.All(tables, section => Assert.True(section.RawSize > section.StoredSize));
        }

        [Fact]
        public void WhatIsBuiltHasNoSections() => Assert.Empty(built.Sections);

        [Fact]
        public void ASectionPrintsWhatItIs()
        {
            using GeodesicIndex opened = GeodesicIndex.Open(built.ToBytes());
            GeodesicSection first = opened.Sections[0];
            Assert.Equal(
                $"META: {first.Coding}, {first.StoredSize} bytes at byte {first.Offset}, {first.RawSize} when decoded",
                first.ToString());
        }

        [Fact]
        public void RoundingMakesStepsLargerAndTheFileSmaller()
        {
            GeodesicMesh mesh = Shapes.Plane(40);
            Assert.Equal(1.0 / 64, new BuildOptions().Rounding);
            using GeodesicIndex coarse = GeodesicIndex.Build(mesh);
            using GeodesicIndex fine = GeodesicIndex.Build(mesh, new BuildOptions { Rounding = 0 });
            Assert.InRange(fine.Info.SmallestStep, double.Epsilon, fine.Info.LargestStep);
            Assert.InRange(coarse.Info.SmallestStep, 2 * fine.Info.SmallestStep, coarse.Info.LargestStep);
            Assert.True(coarse.ToBytes().Length < fine.ToBytes().Length);
        }

        [Fact]
        public void VerticesAreAddedWhereTheMeanErrorIsOverTheTarget()
        {
            (float[] positions, int[] triangles) = Shapes.PlaneArrays(20);
            for (int i = 0; i < positions.Length; i += 3)
                positions[i + 2] = 1.5f * (float)(Math.Sin(positions[i] * 0.7) * Math.Cos(positions[i + 1]));
            GeodesicMesh mesh = GeodesicMesh.From(positions, triangles);
            Assert.Equal(0.0005, new BuildOptions().TargetError);
            using GeodesicIndex plain = GeodesicIndex.Build(mesh, new BuildOptions { TargetError = 0 });
            using GeodesicIndex fine = GeodesicIndex.Build(mesh, new BuildOptions { TargetError = 1e-9 });
            Assert.Equal(0, plain.Info.AddedVertexCount);
            Assert.True(fine.Info.AddedVertexCount > 0);
            Assert.True(fine.Info.ErrorMean < plain.Info.ErrorMean);
            Assert.Equal(plain.Info.WeldedVertexCount, fine.Info.WeldedVertexCount);
            Assert.Equal(plain.VertexCount, fine.VertexCount);
        }

        private void AnswersAsBuilt(GeodesicIndex opened)
        {
            Assert.Equal(built.FromSources(5), opened.FromSources(5));
            Assert.Equal(built.Distance(0, Side * Side - 1), opened.Distance(0, Side * Side - 1));
        }
    }
}
