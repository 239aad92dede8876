using System;

namespace Geoidx
{
    /// <summary>Tells IL2CPP, by its name, to compile a way for native code to call the method.</summary>
    [AttributeUsage(AttributeTargets.Method)]
    internal sealed class MonoPInvokeCallbackAttribute : Attribute
    {
        public MonoPInvokeCallbackAttribute(Type type) => DelegateType = type;

        public Type DelegateType { get; }
    }
}
