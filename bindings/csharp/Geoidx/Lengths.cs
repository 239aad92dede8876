namespace Geoidx
{
    internal static class Lengths
    {
        internal static void CheckEqual(int questions, int answers, string name = "distances")
        {
            if (questions != answers)
                throw new GeodesicArgumentException(
                    $"{name}.Length is {answers}, but {questions} are asked for");
        }
    }
}
