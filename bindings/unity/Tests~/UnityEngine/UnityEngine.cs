#nullable disable
using System;
using System.Linq;

// As much of UnityEngine as the package uses, with the same names and signatures.

namespace UnityEngine
{
    public struct Vector3
    {
        public float x;
        public float y;
        public float z;

        public Vector3(float x, float y, float z)
        {
            this.x = x;
            this.y = y;
            this.z = z;
        }
    }

    public struct Color
    {
        public float r;
        public float g;
        public float b;
        public float a;

        public Color(float r, float g, float b)
        {
            this.r = r;
            this.g = g;
            this.b = b;
            a = 1;
        }

        public static Color red => new Color(1, 0, 0);

        public static Color blue => new Color(0, 0, 1);

        public static Color grey => new Color(0.5f, 0.5f, 0.5f);

        public static Color Lerp(Color a, Color b, float t) =>
            new Color(a.r + (b.r - a.r) * t, a.g + (b.g - a.g) * t, a.b + (b.b - a.b) * t);
    }

    public class Object
    {
        public string name { get; set; } = "";
    }

    public sealed class Mesh : Object
    {
        public Vector3[] vertices { get; set; }

        public int[] triangles { get; set; }

        public Color[] colors { get; set; }

        public bool isReadable { get; set; } = true;
    }

    public class TextAsset : Object
    {
        public virtual byte[] bytes { get; protected set; }
    }

    public sealed class GameObject : Object
    {
        public Transform transform { get; } = new Transform();

        public Component[] Components { get; set; } = { };

        public T GetComponentInChildren<T>() => Components.OfType<T>().FirstOrDefault();
    }

    public class Component : Object
    {
        public GameObject gameObject { get; set; }

        public Transform transform => gameObject.transform;

        public T GetComponent<T>() => gameObject.GetComponentInChildren<T>();
    }

    // Without rotations and parents.
    public class Transform : Component
    {
        public Vector3 position { get; set; }

        public Vector3 localScale { get; set; } = new Vector3(1, 1, 1);

        public Vector3 TransformPoint(Vector3 position) =>
            new Vector3(
                this.position.x + localScale.x * position.x,
                this.position.y + localScale.y * position.y,
                this.position.z + localScale.z * position.z);

        public Vector3 InverseTransformPoint(Vector3 position) =>
            new Vector3(
                (position.x - this.position.x) / localScale.x,
                (position.y - this.position.y) / localScale.y,
                (position.z - this.position.z) / localScale.z);
    }

    public class Time
    {
        public static float deltaTime { get; set; }
    }

    public class Behaviour : Component
    {
    }

    public class MonoBehaviour : Behaviour
    {
    }

    public sealed class MeshFilter : Component
    {
        public Mesh mesh { get; set; }

        public Mesh sharedMesh => mesh;
    }

    public sealed class SkinnedMeshRenderer : Component
    {
        public Mesh sharedMesh { get; set; }
    }

    [AttributeUsage(AttributeTargets.Class)]
    public sealed class RequireComponent : Attribute
    {
        public RequireComponent(Type requiredComponent)
        {
        }
    }
}
