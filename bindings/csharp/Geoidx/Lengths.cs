namespace Geoidx
{
    internal static class Lengths
    {
        internal static void CheckEqual(int questions, int distances)
        {
            if (questions != distances)
                throw new GeodesicArgumentException(
                    $"There is room for {distances} distances, {questions} are asked for.");
        }
    }
}
