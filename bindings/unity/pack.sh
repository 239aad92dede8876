#!/usr/bin/env bash
# pack.sh FOLDER: assembles the Unity package in FOLDER/package and packs it as FOLDER/com.geoidx-VERSION.tgz. The C# of
# ../csharp goes in, the licences, and those native libraries that are in ../csharp/runtimes, or in the folder that
# GEOIDX_RUNTIMES names; at least one must be.
set -euo pipefail
[ $# -eq 1 ] || { echo "usage: pack.sh FOLDER" >&2 && exit 2; }
here=$(cd "$(dirname "$0")" && pwd)
runtimes=${GEOIDX_RUNTIMES:-$here/../csharp/runtimes}
mkdir -p "$1"
out=$(cd "$1" && pwd)
package=$out/package
rm -rf "$package" "$out"/com.geoidx-*.tgz

native_of() { # META
    local plugin
    plugin=$(basename "$(dirname "$1")")
    echo "$runtimes/$plugin/native/$(basename "$1" .meta)"
}

with=() without=()
for meta in "$here"/Runtime/Plugins/*/*.meta; do
    plugin=$(basename "$(dirname "$meta")")
    if [ -f "$(native_of "$meta")" ]; then with+=("$plugin"); else without+=("$plugin"); fi
done
if [ ${#with[@]} -eq 0 ]; then
    echo "There is no native library for Unity (${without[*]}) in $runtimes." >&2
    echo "Run scripts/test_csharp.sh --pack-unity for this platform's, scripts/cross.sh for others." >&2
    exit 1
fi

mkdir -p "$package"
cp -R "$here"/{README.md,Editor,Samples~} "$package"
version=$("$here/../../scripts/version.sh")
sed "s/\"VERSION\"/\"$version\"/" "$here/package.json" >"$package/package.json"
cp "$here"/../../{LICENSE,THIRD-PARTY-NOTICES.txt} "$package"
mkdir -p "$package/Runtime/Geoidx"
cp "$here"/Runtime/{*.cs,*.asmdef,csc.rsp} "$package/Runtime"

(cd "$here/../csharp/Geoidx" &&
    find . -name '*.cs' -not -name '*.LibraryImport.cs' -exec cp --parents -t "$package/Runtime/Geoidx" {} +)

for meta in "$here"/Runtime/Plugins/*/*.meta; do
    native=$(native_of "$meta")
    [ -f "$native" ] || continue
    plugin=$package/Runtime/Plugins/$(basename "$(dirname "$meta")")
    mkdir -p "$plugin"
    cp "$native" "$meta" "$plugin"
done

importer_of() {
    if [ -d "$1" ]; then printf 'folderAsset: yes\nDefaultImporter:\n'; return; fi
    case $1 in
    *.cs) printf 'MonoImporter:\n  serializedVersion: 2\n  defaultReferences: []\n  executionOrder: 0\n  icon: {instanceID: 0}\n' ;;
    *.asmdef) printf 'AssemblyDefinitionImporter:\n' ;;
    */package.json) printf 'PackageManifestImporter:\n' ;;
    *.md) printf 'TextScriptImporter:\n' ;;
    *) printf 'DefaultImporter:\n' ;;
    esac
}

# An asset's identity is made from its place in the package, so that it stays the same from release to release.
write_meta() {
    local place=${1#"$package"/}
    {
        printf 'fileFormatVersion: 2\nguid: %s\n' "$(printf 'com.geoidx/%s' "$place" | md5sum | cut -c1-32)"
        importer_of "$1"
        printf '  externalObjects: {}\n  userData: \n  assetBundleName: \n  assetBundleVariant: \n'
    } >"$1.meta"
}

find "$package" -mindepth 1 -not -name '*.meta' -not -path "$package/Samples~*" | while read -r asset; do
    [ -e "$asset.meta" ] || write_meta "$asset"
done

tar -C "$out" --sort=name --mtime=@0 --owner=0 --group=0 --numeric-owner -cf - package |
    gzip -n >"$out/com.geoidx-$version.tgz"
echo "$out/com.geoidx-$version.tgz: with the native library of ${with[*]}"
[ ${#without[@]} -eq 0 ] || echo "without that of ${without[*]}, which scripts/cross.sh builds"
