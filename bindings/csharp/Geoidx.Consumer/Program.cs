using System;
using System.IO;
using Geoidx;

string path = Path.GetTempFileName();
try
{
    var mesh = GeodesicMesh.From(new float[] { 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0 }, new[] { 0, 1, 2, 0, 2, 3 });
    using (var built = GeodesicIndex.Build(mesh)) built.Save(path);
    using var index = GeodesicIndex.Open(path);
    Console.WriteLine($"geoidx {GeodesicLibrary.Version}: {index.Distance(0, 2)}");
    return Math.Abs(index.Distance(0, 2) - Math.Sqrt(2)) < 1e-4 ? 0 : 1;
}
finally
{
    File.Delete(path);
}
