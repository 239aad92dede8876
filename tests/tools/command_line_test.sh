#!/bin/bash
# Tests of the command line tool: command_line_test.sh TOOL SCRATCH_FOLDER
# Prints what failed and exits with 1 if anything did.
set -u

tool=$(realpath "$1")
mkdir -p "$2" || exit 1
work=$(mktemp -d "$(realpath "$2")/command_line.XXXXXX") || exit 1
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
failures=0
checks=0

fail() {
    echo "FAILED: $*"
    failures=$((failures + 1))
}

# run ARGUMENTS...: fills out.txt, err.txt and $status
run() {
    "$tool" "$@" >out.txt 2>err.txt
    status=$?
    checks=$((checks + 1))
}

succeeds() {
    run "$@"
    [ $status -eq 0 ] || fail "'$*' exited with $status: $(head -c 300 err.txt)"
    [ ! -s err.txt ] || fail "'$*' is not quiet: $(head -c 300 err.txt)"
}

# fails_with PATTERN ARGUMENTS...: exit status 1 and one line on stderr that matches
fails_with() {
    local pattern=$1
    shift
    run "$@"
    [ $status -eq 1 ] || fail "'$*' exited with $status, not 1: $(head -c 300 err.txt)"
    [ "$(wc -l <err.txt)" -eq 1 ] || fail "'$*' has $(wc -l <err.txt) lines on stderr"
    grep -q "^geoidx: " err.txt || fail "'$*' does not say who speaks: $(head -c 300 err.txt)"
    grep -qiE -- "$pattern" err.txt || fail "'$*' does not say '$pattern': $(head -c 300 err.txt)"
}

# misuse ARGUMENTS...: exit status 2 and at most two lines on stderr
misuse() {
    run "$@"
    [ $status -eq 2 ] || fail "'$*' exited with $status, not 2: $(head -c 300 err.txt)"
    local lines
    lines=$(wc -l <err.txt)
    [ "$lines" -ge 1 ] && [ "$lines" -le 2 ] || fail "'$*' has $lines lines on stderr"
}

absent() {
    for file in "$@"; do
        [ ! -e "$file" ] || fail "$file was left behind"
    done
}

no_leftovers() {
    local found
    found=$(find . -name '*.tmp*' -o -name '*~')
    [ -z "$found" ] || fail "temporary files were left behind: $found"
}

same() { cmp -s "$1" "$2" || fail "$1 and $2 differ"; }

# near A B: equal up to what three distances of 16 bits round, of a mesh that is no more than three times as wide
near() { awk -v a="$1" -v b="$2" 'BEGIN { d = a - b; if (d < 0) d = -d; exit !(d <= 1.4e-4 * (1 + b)) }' ||
    fail "$1 is not near $2"; }

float_at() { od -An -tf4 -j $((4 * $2)) -N 4 "$1" | tr -d ' '; }

# ---- Meshes

make_grid() { # SIDE: vertex y * (SIDE + 1) + x at (x, y, 0)
    awk -v n="$1" 'BEGIN {
        for (y = 0; y <= n; ++y) for (x = 0; x <= n; ++x) print "v", x, y, 0
        for (y = 0; y < n; ++y) for (x = 0; x < n; ++x) {
            a = y * (n + 1) + x + 1; b = a + 1; c = b + n + 1; d = a + n + 1
            print "f", a, b, c; print "f", a, c, d
        }
    }'
}

make_sphere() { # RINGS SECTORS: closed, the poles are the last two vertices
    awk -v rings="$1" -v sectors="$2" 'BEGIN {
        pi = atan2(0, -1)
        for (r = 1; r < rings; ++r) for (s = 0; s < sectors; ++s) {
            p = pi * r / rings; a = 2 * pi * s / sectors
            printf "v %.9g %.9g %.9g\n", sin(p) * cos(a), cos(p), sin(p) * sin(a)
        }
        print "v 0 1 0"; print "v 0 -1 0"
        north = (rings - 1) * sectors + 1; south = north + 1
        for (s = 0; s < sectors; ++s) {
            t = (s + 1) % sectors
            print "f", north, t + 1, s + 1
            for (r = 0; r < rings - 2; ++r) {
                a = r * sectors
                print "f", a + s + 1, a + t + 1, a + sectors + t + 1, a + sectors + s + 1
            }
            print "f", south, (rings - 2) * sectors + s + 1, (rings - 2) * sectors + t + 1
        }
    }'
}

cat >cube.off <<'MESH'
OFF
8 6 12
0 0 0
1 0 0
1 1 0
0 1 0
0 0 1
1 0 1
1 1 1
0 1 1
4 3 2 1 0
4 4 5 6 7
4 0 1 5 4
4 1 2 6 5
4 2 3 7 6
4 3 0 4 7
MESH

cat >gap.off <<'MESH'
OFF
6 2 0
0 0 0
1 0 0
0 1 0
1.01 0 0
0 1.01 0
1 1 0
3 0 1 2
3 3 5 4
MESH

cat >two_parts.stl <<'MESH'
solid two triangles apart
facet normal 0 0 1
 outer loop
  vertex 0 0 0
  vertex 1 0 0
  vertex 0 1 0
 endloop
endfacet
facet normal 0 0 1
 outer loop
  vertex 5 0 0
  vertex 6 0 0
  vertex 5 1 0
 endloop
endfacet
endsolid
MESH

make_grid 20 >grid.obj
make_sphere 12 24 >sphere.obj
awk '/^v/ { v[++n] = $2 " " $3 " " $4 } /^f/ { f[++m] = NF - 1; for (i = 2; i <= NF; ++i) f[m] = f[m] " " $i - 1 }
    END { print "ply\nformat ascii 1.0\nelement vertex " n "\nproperty double x\nproperty double y\nproperty double z"
          print "element face " m "\nproperty list uchar int vertex_indices\nend_header"
          for (i = 1; i <= n; ++i) print v[i]
          for (i = 1; i <= m; ++i) print f[i] }' grid.obj >grid.ply

# ---- What works

succeeds --help
succeeds --version
grep -q '^geoidx [0-9]' out.txt || fail "no version"
for command in build convert info verify sssd msad path exact bench; do succeeds $command --help; done

for mesh in grid.obj grid.ply sphere.obj cube.off two_parts.stl; do
    succeeds build $mesh -o ${mesh%.*}.${mesh#*.}.geoidx
    [ ! -s out.txt ] || fail "build of $mesh prints"
    succeeds verify $mesh.geoidx
    succeeds info $mesh.geoidx
done
same grid.obj.geoidx grid.ply.geoidx
no_leftovers

succeeds info grid.obj.geoidx
grep -qE '^vertices +441$' out.txt || fail "info does not say 441 vertices"
grep -qE '^triangles +800$' out.txt || fail "info does not say 800 triangles"
succeeds info grid.obj.geoidx --json
grep -q '"vertex_count": 441' out.txt || fail "info --json does not say 441 vertices"
/usr/bin/python3 -c 'import json; json.load(open("out.txt"))' 2>/dev/null || fail "info --json is no JSON"

succeeds build grid.obj -o options.geoidx --metric edges --delta 1 --weld-tolerance 1e-9 --levels 2 --patches 4,3 \
    --seed 7 --threads 1 --lloyd-iterations 2
succeeds info options.geoidx
grep -qE '^metric +edges$' out.txt || fail "--metric edges is not in the index"
grep -qE '^seed +7$' out.txt || fail "--seed 7 is not in the index"
grep -qE '^levels +2$' out.txt || fail "--levels 2 is not in the index"

succeeds build grid.obj -o grid.obj.geoidx
succeeds sssd grid.obj.geoidx 0 440 0 20 5 5
[ "$(wc -l <out.txt)" -eq 3 ] || fail "sssd of three pairs prints $(wc -l <out.txt) lines"
[ "$(awk 'NR == 2 { print $1, $2 }' out.txt)" = "0 20" ] || fail "sssd does not repeat the ids"
near "$(awk 'NR == 2 { print $3 }' out.txt)" 20
near "$(awk 'NR == 3 { print $3 }' out.txt)" 0

succeeds sssd grid.obj.geoidx 0 440 7 300 --exact grid.obj
awk 'NF != 5 || $5 < 0 || $5 > 0.1 { exit 1 }' out.txt || fail "sssd --exact: $(cat out.txt)"
near "$(awk 'NR == 1 { print $4 }' out.txt)" 28.2842712
succeeds build gap.off -o gap.geoidx --weld-tolerance 0.1
succeeds sssd gap.geoidx 0 5 --exact gap.off --weld-tolerance 0.1
fails_with 'gap\.off: .*they differ in weld_tolerance' sssd gap.geoidx 0 5 --exact gap.off
succeeds sssd two_parts.stl.geoidx 0 1 0 3 --exact two_parts.stl
grep -qE '^0 3 inf inf 0$' out.txt || fail "unreachable is not inf: $(cat out.txt)"

succeeds build gap.off -o kept.geoidx --weld-tolerance 0.1 --store-mesh
succeeds path kept.geoidx 0 5 -o way.CSV
[ "$(head -n 1 way.CSV)" = "triangle,weight0,weight1,weight2,x,y,z" ] || fail "way.CSV: $(head -n 1 way.CSV)"

succeeds msad sphere.obj.geoidx 0 100 -o far.f32 --mesh sphere.obj
[ "$(stat -c %s far.f32)" -eq $((4 * 266)) ] || fail "far.f32 has the wrong size"
near "$(float_at far.f32 100)" 0
succeeds msad grid.obj.geoidx 0 -o grid.f32 --mesh grid.obj --png grid.png --size 300x200 --isolines 8
near "$(float_at grid.f32 20)" 20
[ "$(head -c 8 grid.png | od -An -tx1 | tr -d ' \n')" = 89504e470d0a1a0a ] || fail "grid.png is no PNG"
[ "$(od -An -tu1 -j 16 -N 8 grid.png | tr -s ' ')" = " 0 0 1 44 0 0 0 200" ] || fail "grid.png is not 300x200"
succeeds exact grid.obj 0 -o exact.f32 --png exact.png --size 64x64 --up z
near "$(float_at exact.f32 440)" 28.2842712
for output in /dev/stdout -; do
    "$tool" msad grid.obj.geoidx 0 -o $output --format f32 | cmp -s - grid.f32 || fail "-o $output differs from a file"
done
absent ./-
succeeds msad grid.obj.geoidx 0 -o grid.csv
"$tool" msad grid.obj.geoidx 0 -o - | cmp -s - grid.csv || fail "-o - is not the csv file"
"$tool" build grid.obj -o - | cmp -s - grid.obj.geoidx || fail "build -o - is not the index"
succeeds msad grid.obj.geoidx 0 --png alone.png --mesh grid.obj --size 300x200 --isolines 8
same alone.png grid.png
"$tool" exact grid.obj 0 --png - --size 64x64 --up z | cmp -s - exact.png || fail "--png - is not the picture"
ln -s grid.f32 link.f32
succeeds msad grid.obj.geoidx 0 -o link.f32
[ -L link.f32 ] || fail "an output that is a link was replaced"
ln -s made.f32 dangling.f32
succeeds msad grid.obj.geoidx 0 -o dangling.f32
[ -L dangling.f32 ] && [ -f made.f32 ] || fail "a link to a file that is not there was replaced"
ln -s made.geoidx dangling.geoidx
succeeds build grid.obj -o dangling.geoidx
[ -L dangling.geoidx ] && [ -f made.geoidx ] || fail "a link to an index that is not there was replaced"
succeeds sssd grid.obj.geoidx 0 440 7 300
cp out.txt pairs.txt
printf '0 440\n\n  7\t300 # a pair\r\n' >pairs.in
succeeds sssd grid.obj.geoidx - <pairs.in
same out.txt pairs.txt
succeeds sssd grid.obj.geoidx - </dev/null
[ ! -s out.txt ] || fail "no pairs have answers"
"$tool" build grid.obj -o progress.geoidx --progress >out.txt 2>err.txt || fail "build --progress fails"
[ "$(awk '{ print $1 }' err.txt | tr -d '\n')" = "10%20%30%40%50%60%70%80%90%100%" ] ||
    fail "build --progress says: $(cat err.txt)"
same progress.geoidx grid.obj.geoidx
no_leftovers

# ---- Wrong usage

misuse
misuse path kept.geoidx 0 5 --weld-tolerance 0.1
grep -q 'weld-tolerance is of MESH' err.txt || fail "--weld-tolerance without MESH: $(cat err.txt)"
misuse unknown
grep -q "there is no command 'unknown'; there are build, " err.txt || fail "an unknown command: $(cat err.txt)"
while read -r typed meant; do
    misuse "$typed" grid.obj.geoidx
    grep -q "did you mean '$meant'?" err.txt || fail "'$typed' is not taken for '$meant': $(cat err.txt)"
done <<'WORDS'
biuld build
buid build
Build build
inf info
veryfi verify
ssd sssd
msd msad
exakt exact
benhc bench
WORDS
while read -r words; do
    misuse $words
    option=${words%% *}
    grep -q -- "'$option' stands before the command; options come after it, as in 'geoidx [a-zA-Z]* \.\.\. $option'" err.txt ||
        fail "'$words' is not told that options come after the command: $(cat err.txt)"
done <<'LINES'
--json info grid.obj.geoidx
--json info
--json
--seed 3 build grid.obj -o x.geoidx
-o x.geoidx build grid.obj
--unknown info grid.obj.geoidx
LINES
misuse build
misuse build grid.obj
misuse build grid.obj -o x.geoidx --metric heat
misuse build grid.obj -o x.geoidx --levels 9
misuse build grid.obj -o x.geoidx --levels many
misuse build grid.obj -o x.geoidx --patches 1,2,3,4,5,6,7,8,9
misuse build grid.obj -o x.geoidx --patches 4,x
for option in --seed --threads --patches --levels --lloyd-iterations; do
    for value in -1 99999999999999999999 x 1.5; do misuse build grid.obj -o x.geoidx $option $value; done
done
misuse build grid.obj -o x.geoidx --threads 4294967296
misuse build grid.obj -o x.geoidx --delta x
misuse build grid.obj -o x.geoidx --unknown
misuse info
misuse sssd grid.obj.geoidx
misuse sssd grid.obj.geoidx 1
misuse sssd grid.obj.geoidx 1 2 3
for id in -1 4294967296 99999999999999999999 x 1.5 1e2 0x10 "" " 1"; do
    misuse sssd grid.obj.geoidx 0 "$id"
    misuse msad grid.obj.geoidx "$id" -o x.f32
    misuse exact grid.obj "$id" -o x.f32
done
misuse msad grid.obj.geoidx -o x.f32
misuse msad grid.obj.geoidx 0
misuse msad grid.obj.geoidx 0 -o x.f32 --png x.png
misuse msad grid.obj.geoidx 0 -o x.f32 --size 100x100
for output in x x.txt x.f32.gz x. f32; do misuse msad grid.obj.geoidx 0 -o $output; done
misuse msad grid.obj.geoidx 0 -o x.csv --format npy
misuse msad grid.obj.geoidx 0 -o x.csv --format xyz
misuse msad grid.obj.geoidx 0 -o x.ply
grep -q -- '--mesh' err.txt || fail "a ply without its mesh: $(cat err.txt)"
misuse msad grid.obj.geoidx 0 -o - --json
misuse msad grid.obj.geoidx 0 -o - --png - --mesh grid.obj
misuse build grid.obj -o - --json
misuse sssd grid.obj.geoidx - 1
misuse sssd grid.obj.geoidx - -
for size in 100 100x x100 0x0 -5x100 100x100x100 99999999x10; do
    misuse msad grid.obj.geoidx 0 -o x.f32 --mesh grid.obj --png x.png --size="$size"
done
absent x.geoidx x.f32 x.png

# ---- Bad meshes

sed '3s/.*/v nan 0 0/' grid.obj >nan.obj
sed '3s/.*/v 0 inf 0/' grid.obj >inf.obj
echo 'f 1 2 442' | cat grid.obj - >range.obj
: >empty.obj
echo 'v 0 0 0' >no_faces.obj
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 1 2 5\n' >fan.obj
mkdir folder
cp grid.obj mesh.xyz

fails_with 'nan\.obj.*vertex 2' build nan.obj -o x.geoidx
fails_with 'inf\.obj.*vertex 2' build inf.obj -o x.geoidx
fails_with 'range\.obj: line 1242:.*442' build range.obj -o x.geoidx
fails_with 'empty\.obj: .*no vertices' build empty.obj -o x.geoidx
fails_with 'no_faces\.obj: .*no triangles' build no_faces.obj -o x.geoidx
fails_with 'fan\.obj: .*edge.* 0 .*1 .*3 triangles' build fan.obj -o x.geoidx --refuse-edges-of-many
succeeds build fan.obj -o fan.geoidx
fails_with 'missing\.obj: No such file' build missing.obj -o x.geoidx
fails_with 'folder: is a directory' build folder -o x.geoidx
fails_with '\.obj, \.ply, \.off, \.stl' build mesh.xyz -o x.geoidx
absent x.geoidx
fails_with 'nan\.obj' exact nan.obj 0 -o x.f32 --png x.png
fails_with 'vertex 441 ' exact grid.obj 441 -o x.f32 --png x.png
absent x.f32 x.png

# ---- Bad outputs: said before the mesh is looked at

for mesh in grid.obj missing.obj; do
    fails_with 'folder: is a directory' build $mesh -o folder
    fails_with 'nowhere/x: No such file' build $mesh -o nowhere/x
    fails_with 'grid\.ply/x: Not a directory' build $mesh -o grid.ply/x
    fails_with '/proc/x: ' build $mesh -o /proc/x
    fails_with 'not a regular file' build $mesh -o /dev/null
done
[ -c /dev/null ] || fail "/dev/null was replaced"
cp grid.obj copy.obj
fails_with 'is an input' build copy.obj -o copy.obj
same copy.obj grid.obj
mkdir folder.csv
for output in folder.csv nowhere/x.csv grid.ply/x.csv /proc/x.csv; do
    fails_with "$output: " msad grid.obj.geoidx 0 -o $output
    fails_with "$output: " msad grid.obj.geoidx 0 -o x.f32 --mesh grid.obj --png $output
done
ln -s round.csv round.csv
fails_with 'round.csv: Too many levels' msad grid.obj.geoidx 0 -o round.csv
fails_with 'round.csv: Too many levels' build missing.obj -o round.csv
[ -L round.csv ] || fail "a link in a circle was replaced"
fails_with 'both -o and --png' msad grid.obj.geoidx 0 -o x.csv --mesh grid.obj --png x.csv
fails_with 'both -o and --png' msad grid.obj.geoidx 0 -o x.csv --mesh grid.obj --png ./folder/../x.csv
absent x.f32 x.csv
if [ -w /dev/full ]; then
    for arguments in "info grid.obj.geoidx" "sssd grid.obj.geoidx 0 1 --json" "verify grid.obj.geoidx" "--help" \
        "build grid.obj -o full.geoidx --json" "build grid.obj -o -" "--version" "msad --help"; do
        "$tool" $arguments >/dev/full 2>err.txt
        [ $? -eq 1 ] && [ "$(wc -l <err.txt)" -eq 1 ] || fail "'$arguments' does not notice a full disk: $(cat err.txt)"
    done
    fails_with '/dev/full: ' msad grid.obj.geoidx 0 -o /dev/full --format npy
    "$tool" msad grid.obj.geoidx 0 -o - >/dev/full 2>err.txt
    [ $? -eq 1 ] && grep -q '^geoidx: msad: standard output: ' err.txt || fail "-o - on a full disk: $(cat err.txt)"
fi
no_leftovers

# ---- Bad queries

fails_with 'vertex 441 ' sssd grid.obj.geoidx 0 441
fails_with 'vertex 4294967295 ' sssd grid.obj.geoidx 4294967295 0
[ ! -s out.txt ] || fail "a failed sssd prints distances"
fails_with 'vertex 441 ' msad grid.obj.geoidx 0 441 -o x.f32
fails_with 'another mesh|built from' sssd grid.obj.geoidx 0 1 --exact sphere.obj
fails_with 'another mesh|built from' msad grid.obj.geoidx 0 -o x.f32 --mesh sphere.obj --png x.png
# A mesh is the same one in more digits than a float holds and in as many, but not in fewer.
for digits in 17 9 6; do
    awk -v form="v %.${digits}g %.${digits}g %.${digits}g\n" \
        '/^v/ { printf form, $2 / 3, $3 / 3, $4 / 3; next } { print }' grid.obj >third_$digits.obj
done
for mesh in third_17 third_9; do
    succeeds build $mesh.obj -o third.geoidx
    for same in third_17 third_9; do
        succeeds sssd third.geoidx 0 1 --exact $same.obj
        succeeds msad third.geoidx 0 -o third.f32 --mesh $same.obj --png third.png
    done
    fails_with 'built from' sssd third.geoidx 0 1 --exact third_6.obj
    fails_with 'built from' msad third.geoidx 0 -o third.f32 --mesh third_6.obj --png third.png
done
absent x.f32 x.png

while IFS='|' read -r lines pattern; do
    printf "$lines" >pairs.txt
    "$tool" sssd grid.obj.geoidx - <pairs.txt >out.txt 2>err.txt
    [ $? -eq 1 ] && [ "$(wc -l <err.txt)" -eq 1 ] && [ ! -s out.txt ] || fail "the pairs '$lines' pass"
    grep -qE "^geoidx: sssd: $pattern" err.txt || fail "the pairs '$lines': $(cat err.txt)"
done <<'PAIRS'
0 1\n2\n|standard input: line 2: .*two
0 1 2 3\n|standard input: line 1: .*two
0 1\n\n# 7 8\n-1 4\n|standard input: line 4: '-1' is not a vertex id
0,1\n|standard input: line 1:
0 4294967296\n|standard input: line 1: .*2\^32
0 441\n|.*vertex 441
PAIRS
"$tool" sssd grid.obj.geoidx - <&- >out.txt 2>err.txt
[ $? -eq 1 ] && grep -q 'standard input: ' err.txt || fail "a closed standard input: $(cat err.txt)"
"$tool" info grid.obj.geoidx >&- 2>err.txt
[ $? -eq 1 ] && grep -q 'standard output: ' err.txt || fail "a closed standard output: $(cat err.txt)"
"$tool" build grid.obj -o closed.geoidx --json >&- 2>err.txt
[ $? -eq 1 ] || fail "--json to a closed standard output goes unnoticed"
same closed.geoidx grid.obj.geoidx

# ---- Bad index files

reading_fails() { # FILE PATTERN
    fails_with "$2" info "$1"
    fails_with "$2" verify "$1"
    fails_with "$2" sssd "$1" 0 1
    fails_with "$2" msad "$1" 0 -o x.f32
    absent x.f32
}

reading_fails grid.obj 'grid\.obj: '
reading_fails missing.geoidx 'missing\.geoidx: '
reading_fails folder 'folder: '
: >empty.geoidx
reading_fails empty.geoidx 'empty\.geoidx: '
[ ! -c /dev/zero ] || reading_fails /dev/zero '/dev/zero: the first 8 bytes are not those of an index'

size=$(stat -c %s grid.obj.geoidx)
for length in 1 7 8 40 100 $((size / 4)) $((size / 2)) $((size - 64)) $((size - 1)); do
    head -c "$length" grid.obj.geoidx >short.geoidx
    reading_fails short.geoidx 'short\.geoidx: '
done
{ cat grid.obj.geoidx; echo; } >long.geoidx
reading_fails long.geoidx 'long\.geoidx: '

for part in 0 1 2 3 4 5 6 7 8 9 10 11; do
    offset=$((part * (size - 1) / 11))
    cp grid.obj.geoidx changed.geoidx
    byte=$(od -An -tu1 -j $offset -N 1 changed.geoidx | tr -d ' ')
    printf "\\x$(printf %02x $((byte ^ 0x55)))" |
        dd of=changed.geoidx bs=1 seek=$offset conv=notrunc status=none
    reading_fails changed.geoidx 'changed\.geoidx: '
done

# ---- Cancelling

make_grid 150 >large.obj
while read -r signal expected line; do
    : >err.txt
    "$tool" build large.obj -o cancelled.geoidx --json --progress >out.txt 2>err.txt &
    pid=$!
    while [ ! -s err.txt ] && kill -0 $pid 2>/dev/null; do sleep 0.1; done # until it says how far it is
    kill -$signal $pid 2>/dev/null || fail "the build was over before it could be cancelled"
    wait $pid
    status=$?
    [ $status -eq $expected ] || fail "after SIG$signal a build exited with $status"
    grep -qx "geoidx: $line" err.txt || fail "after SIG$signal a build says: $(cat err.txt)"
    [ ! -s out.txt ] || fail "a build that was ended prints: $(cat out.txt)"
    absent cancelled.geoidx
done <<'SIGNALS'
INT 130 interrupted
TERM 143 terminated
SIGNALS
no_leftovers

# Whenever it comes, the old file or the new one is whole. The two commands write one each.
make_grid 40 >middle.obj
succeeds build middle.obj -o middle.geoidx
succeeds exact middle.obj 0 -o middle.csv
interrupted=0
for delay in 0.01 0.02 0.03 0.05 0.08 0.1 0.15 0.2 0.3 0.5 0.8; do
    while read -r file arguments; do
        cp $file again_$file
        "$tool" $arguments --json >out.txt 2>err.txt </dev/null &
        pid=$!
        sleep $delay
        kill -INT $pid 2>/dev/null
        wait $pid
        status=$?
        checks=$((checks + 1))
        case $status in
        0) ;;
        130) interrupted=$((interrupted + 1)) ;;
        *) fail "'$arguments', interrupted after $delay s, exited with $status: $(cat err.txt)" ;;
        esac
        same $file again_$file
    done <<'COMMANDS'
middle.geoidx build middle.obj -o again_middle.geoidx
middle.csv exact middle.obj 0 -o again_middle.csv --png again.png
COMMANDS
done
[ $interrupted -gt 0 ] || fail "nothing was interrupted"
no_leftovers

# A reader that has enough does not count as a failure of the tool, nor leave it running.
"$tool" msad grid.obj.geoidx 0 -o - 2>err.txt | head -n 1 >out.txt
[ "$(cat out.txt)" = vertex,distance ] && [ ! -s err.txt ] || fail "a reader that ends early: $(cat err.txt)"

echo "$checks runs, $failures failures"
[ $failures -eq 0 ]
