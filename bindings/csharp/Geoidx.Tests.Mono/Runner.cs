using System;
using System.Collections.Generic;
using System.Linq;
using System.Reflection;
using System.Threading.Tasks;
using Xunit;

namespace Geoidx.Tests
{
    /// <summary>
    /// Runs the tests of this assembly where xunit's own runner does not: exit code 0 when all pass. With the argument
    /// "version" it says which native library it finds instead; "leave" and "unload" are those of
    /// <see cref="Endings"/>.
    /// </summary>
    internal static class Runner
    {
        private static int Main(string[] arguments) => arguments.FirstOrDefault() switch
        {
            "version" => PrintVersion(),
            "leave" => Endings.Leave(arguments[1]),
            "unload" => Endings.Unload(arguments[1]),
            _ => RunTests(),
        };

        private static int PrintVersion()
        {
            try
            {
                Console.WriteLine(GeodesicLibrary.Version);
                return 0;
            }
            catch (GeodesicLibraryException e)
            {
                Console.WriteLine(e.Message);
                return 1;
            }
        }

        private static int RunTests()
        {
            int passed = 0, failed = 0;
            foreach (MethodInfo test in Tests())
            {
                foreach (object?[] arguments in Arguments(test))
                {
                    if (Passes(test, arguments)) passed++;
                    else failed++;
                }
            }
            Console.WriteLine($"Passed: {passed}, failed: {failed}");
            return failed == 0 && passed > 0 ? 0 : 1;
        }

        private static IEnumerable<MethodInfo> Tests() =>
            typeof(Runner).Assembly.GetTypes()
                .OrderBy(type => type.FullName, StringComparer.Ordinal)
                .SelectMany(type => type.GetMethods())
                .Where(method => method.IsDefined(typeof(FactAttribute)));

        private static IEnumerable<object?[]> Arguments(MethodInfo test) =>
            test.IsDefined(typeof(TheoryAttribute))
                ? test.GetCustomAttributes<InlineDataAttribute>().SelectMany(data => data.GetData(test))
                : new[] { Array.Empty<object?>() };

        private static bool Passes(MethodInfo test, object?[] arguments)
        {
            string name = $"{test.DeclaringType!.Name}.{test.Name}({string.Join(", ", arguments)})";
            try
            {
                object instance = Activator.CreateInstance(test.DeclaringType)!;
                (test.Invoke(instance, arguments) as Task)?.GetAwaiter().GetResult();
                (instance as IDisposable)?.Dispose();
                return true;
            }
            catch (Exception e)
            {
                Console.WriteLine($"FAILED {name}: {(e as TargetInvocationException)?.InnerException ?? e}");
                return false;
            }
        }
    }
}
