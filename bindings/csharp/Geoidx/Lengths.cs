namespace Geoidx
{
    internal static class Lengths
    {
        internal static void CheckEqual(int questions, int distances)
        {
            if (questions != distances)
                throw new GeodesicArgumentException(
                    $"distances.Length is {distances}, but {questions} are asked for");
        }
    }
}
