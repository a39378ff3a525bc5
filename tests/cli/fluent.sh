#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# kirsch-nodes on Fluent's .msh: by faces, as Fluent and its like write it, and by the corners of cells, as meshio does.
prefix=fluent
. tests/cli/steps
python=/usr/bin/python3

convert() {
    "$build/kirsch-nodes" --convert "$@" --output "$work"
}

# The same nodes, volumes and sets as from gmsh's own file; the last words: sets that the file has beside, or none
same() { # gmsh's NAME, Fluent's NAME, tolerance of the places and volumes, sets
    convert "$work/$1.msh" || return 1
    cp "$work/$1.nodes.h5" "$work/gmsh.h5"
    convert "$work/$2.msh" || return 1
    $python - "$work/gmsh.h5" "$work/$2.nodes.h5" "$3" $4 <<'PY'
import sys
import h5py
import numpy as np
def read(path):
    with h5py.File(path) as f:
        rows = np.column_stack([f["nodes/position"][:], f["nodes/volume"][:]])
        order = np.lexsort(np.round(rows, 5).T)
        place = np.argsort(order)
        sets = {name: (np.sort(place[members[:]]), members.attrs.get("measure")) for name, members in f["sets"].items()}
    return rows[order], sets
(one, sets), (two, more) = read(sys.argv[1]), read(sys.argv[2])
worst = abs(one - two).max()
print("largest difference", worst)
assert worst <= float(sys.argv[3])
if sys.argv[4] == "none":
    sets = {}
    sys.argv.pop()
assert sorted(more) == sorted([*sets, *sys.argv[4:]]), (sorted(sets), sorted(more))
for name in sets:
    assert np.array_equal(sets[name][0], more[name][0]), name
    assert (sets[name][1] is None) == (more[name][1] is None), name
    assert sets[name][1] is None or abs(sets[name][1] - more[name][1]) <= 10 * float(sys.argv[3]), name
PY
}

# A plate of quadrilaterals (a zone) and triangles (another), not all alike.
cat >"$work/plate.geo" <<'GEO'
Point(1)={0,0,0,.3}; l[]=Extrude{1,0,0}{Point{1}; Layers{4};};
s[]=Extrude{{0,0,1},{2,0,0},-1.1}{Curve{l[1]}; Layers{7}; Recombine;};
t[]=Extrude{.8,.4,0}{Curve{s[2]}; Layers{2};};
Physical Surface("squares",3)={s[1]}; Physical Surface("triangles",4)={t[1]};
Physical Curve("bottom",11)={l[1]}; Physical Curve("end",12)={t[0]};
GEO
# Hexahedra with warped faces, wedges beside them, and one zone of both kinds.
cat >"$work/block.geo" <<'GEO'
Point(1)={0,0,0,.4}; l[]=Extrude{1,0,0}{Point{1}; Layers{4}; Recombine;};
s[]=Extrude{0,1,0}{Curve{l[1]}; Layers{3}; Recombine;};
t[]=Extrude{.5,1,0}{Curve{s[0]}; Layers{2};};
v[]=Extrude{{0.3,0.2,1},{4,0.3,0.1},{-1.2,-.4,.2},0.5}{Surface{s[1],t[1]}; Layers{4}; Recombine;};
Physical Volume("all",6)={1,2}; Physical Surface("floor",1)={s[1],t[1]};
GEO
cat >"$work/tets.geo" <<'GEO'
SetFactory("OpenCASCADE"); Box(1)={0,0,0,1,.8,.6}; Sphere(2)={.4,.3,.3,.2};
BooleanFragments{Volume{1}; Delete;}{Volume{2}; Delete;}
Mesh.CharacteristicLengthMax=.2; Physical Volume("ball",5)={2}; Physical Volume("matrix",8)={3};
Physical Surface("end",1)=Surface In BoundingBox{-.01,-.01,-.01,.01,.81,.61};
GEO
for body in plate block tets; do
    dimension=3
    [ $body = plate ] && dimension=2
    gmsh -$dimension "$work/$body.geo" -format msh41 -o "$work/$body.msh" >"$work/log" 2>&1
done
# Cubes, each cut into six pyramids about a point that is not quite its middle.
$python - "$work/pyramids.msh" <<'PY' >"$work/log" 2>&1
import sys
import meshio
import numpy as np
n = 3
grid = np.stack(np.meshgrid(*[np.arange(n + 1.)] * 3, indexing="ij"), axis=-1).reshape(-1, 3)
at = lambda i, j, k: (i * (n + 1) + j) * (n + 1) + k
points, rows, ends = list(grid), [], []
for i, j, k in np.ndindex(n, n, n):
    c = [at(i + x, j + y, k + z) for x, y, z in
         [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]]
    points.append(np.array([i, j, k]) + .5 + .1 * np.sin([i + 2 * j, j + 3 * k, k + i]))
    for side in [(0, 1, 2, 3), (4, 7, 6, 5), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0)]:
        rows.append([c[s] for s in side] + [len(points) - 1])
    if i == 0:
        ends.append([c[s] for s in (3, 7, 4, 0)])
mesh = meshio.Mesh(np.array(points), [("pyramid", rows), ("quad", ends)],
                   cell_data={"gmsh:physical": [np.full(len(rows), 2), np.full(len(ends), 1)],
                              "gmsh:geometrical": [np.full(len(rows), 1), np.full(len(ends), 1)]},
                   field_data={"heap": np.array([2, 3]), "end": np.array([1, 2])})
meshio.write(sys.argv[1], mesh, file_format="gmsh22", binary=False)
PY
for body in plate block tets pyramids; do
    for how in "" 3 "swap"; do
        $python tests/cli/by_faces.py "$work/$body.msh" "$work/${body}_faces$how.msh" $how >"$work/log" 2>&1
    done
    # The rest of the boundary is a zone, too. Places and volumes: rounding of another first corner.
    check $body same $body ${body}_faces 1e-14 rest
    check ${body}_binary same $body ${body}_faces3 1e-14 rest
    check ${body}_sides_exchanged same $body ${body}_facesswap 1e-14 rest
done
$python tests/cli/by_faces.py "$work/block.msh" "$work/block_single.msh" 2 >"$work/log" 2>&1
check block_single_precision same block block_single 2e-7 rest # half of 2^-22 for coordinates up to 4
cp "$work/tets_faces.msh" "$work/tets.cas"
check case_file convert "$work/tets.cas"

# What cannot be read is named with its line: two triangles and a quadrilateral, spoilt in turn.
cat >"$work/small.msh" <<'FLUENT'
(0 "Fluent, by faces")
(2 2)
(10 (0 1 6 0 2))
(10 (1 1 6 1 2)(
0 0
1 0
1 1
0 1
2 0
2 1
))
(12 (0 1 3 0))
(12 (a 1 3 1 0)(1 1 3))
(13 (0 1 8 0))
(13 (3 1 2 2 2)(
1 3 2 1
2 3 1 3
))
(13 (b 3 8 3 2)(
1 2 1 0
3 4 2 0
4 1 2 0
2 5 3 0
5 6 3 0
6 3 3 0
))
(39 (10 solid plate 1)())
(45 (11 wall rim)())
FLUENT
small() {
    convert "$work/$1.msh" || return 1
    $python - "$work/$1.nodes.h5" <<'PY'
import sys
import h5py
import numpy as np
with h5py.File(sys.argv[1]) as f:
    assert np.array_equal(f["nodes/volume"][:], [.5, .5, 1]), f["nodes/volume"][:]
    assert {name: list(rows) for name, rows in f["sets"].items()} == {"plate": [0, 1, 2], "rim": [0, 1, 2]}
PY
}
check zones_count_in_two_ways small small
# As TGrid 2.4 did: comments without quotes, no dimension of the nodes' declaration, no kind of the cells, c0 on the right.
sed 's/^(0 .*/(0 grid\n  nodes: (10 (id start end type) (x y ...))\n)/; s/(10 (0 1 6 0 2))/(10 (0 1 6 0))/
    s/(12 (a 1 3 1 0)(1 1 3))/(12 (a 1 3 1))/; s/(13 (b 3 8 3 2)(/(13(b 3 8 3 2) (/
    s/^\([1-6]\) \([1-6]\) \([0-3] [0-3]\)$/\2 \1 \3/' "$work/small.msh" >"$work/tgrid.msh"
check tgrid small tgrid
spoilt() { # name, line of sed, words
    sed "$2" "$work/small.msh" >"$work/spoilt.msh"
    cmp -s "$work/small.msh" "$work/spoilt.msh" && echo "# $1 spoils nothing"
    check "$1" stops 2 "$3" convert "$work/spoilt.msh"
}
spoilt periodic 's/(b 3 8 3 2)/(b 3 8 c 2)/' "line 19: of the zone 11 (hexadecimal b): it is periodic.*slit-periodic"
spoilt shadow 's/(b 3 8 3 2)/(b 3 8 8 2)/' "line 19: of the zone 11 (hexadecimal b): it is periodic"
spoilt pairs '$a (18 (1 1 b c)(\n3 6\n))' "line 29: of these faces: it is periodic"
spoilt parent_faces 's/(b 3 8 3 2)/(b 3 8 1f 2)/' "line 19: the mesh was refined with hanging nodes; write it as it was"
spoilt parent_cells 's/(a 1 3 1 0)/(a 1 3 20 0)/' "line 13: the mesh was refined with hanging nodes"
spoilt tree_of_faces '$a (59 (1 1 3 4)(\n2 3 4\n))' "line 29: the mesh was refined with hanging nodes"
spoilt polygon 's/^4 1 2 0/4 1 3 0/' "cell 2 has 2 faces, 0 of them with four nodes; polygons and polyhedra are not read"
spoilt surfaces_only '/^(12/d' "holds no cells (section 12), only a mesh of surfaces"
spoilt turned_face 's/^3 4 2 0/3 4 0 2/' "cell 2: its 3 faces, .*face 1 (line 16), make no triangle: they do not close"
spoilt other_kind 's/(a 1 3 1 0)(1 1 3)/(a 1 3 1 1)/' "cell 3: its 4 faces, .*face 6 (line 23), make no quad"
spoilt node_beyond 's/^5 6 3 0/5 7 3 0/' "face 7 (line 24) has a node that is not there"
spoilt cell_beyond 's/^5 6 3 0/5 6 4 0/' "face 7 (line 24) has a cell that is not there (there are 3)"
spoilt alone 's/^5 6 3 0/5 6 0 0/' "face 7 (line 24) has no cell on either side"
spoilt face_left_out '/^5 6 3 0/d' "the faces that begin on line 19 are not the 6 that were announced"
spoilt faces_left_out '/^(13 (3/,/^))/d' "face 1 is declared, but in no section"
spoilt no_number 's/^5 6 3 0/5 6 x 0/' "the faces that begin on line 19 hold a word that is no hexadecimal number"
spoilt node_left_out 's/^2 1$//' "the nodes that begin on line 4 are 10 numbers, expected 12"
spoilt node_of_words 's/^2 1$/2 one/' "the nodes that begin on line 4: .*one"
spoilt too_many 's/(0 1 8 0)/(0 1 fffffff 0)/' "line 14: 268435455 are announced, and the file has"
spoilt kind_of_faces 's/(b 3 8 3 2)/(b 3 8 3 9)/' "line 19: faces of kind 9 are not known"
spoilt polyhedra 's/^(13 (3 1 2 2 2)/(13 (3 1 2 2 5)/; s/^1 3 2 1/2 1 3 2 1/; s/^2 3 1 3/5 1 2 3 4 5 1 3/' \
    "face 2 (line 17) has 5 nodes: polyhedra are not read"

# A file cut anywhere before the end of its faces: a sentence with the line, never less of a mesh.
cut_anywhere() { # file, the words that end its faces
    end=$($python -c "import sys; print(open(sys.argv[1], 'rb').read().rindex(sys.argv[2].encode()))" "$work/$1.msh" "$2")
    for part in 3 11 19 29 42 55 68 77 88 99 100; do
        head -c $((end * part / 100)) "$work/$1.msh" >"$work/cut.msh"
        stops 2 "cut.msh: line [0-9]*:\|that begin on line [0-9]*\|in no section of faces\|does not hold all nodes\|\
declares no faces" convert "$work/cut.msh" || return 1
    done
}
check cut cut_anywhere block_faces "))"
check cut_binary cut_anywhere block_faces3 "End of Binary Section   3013"

# As meshio writes it, by the corners of cells, ASCII and binary; zones make no sets, and that is said.
PYTHONPATH=tests/cli $python -B - "$work" <<'PY' >"$work/log" 2>&1
import sys
import meshio
from by_meshio import bodies
work = sys.argv[1]
for name, m, cells in bodies(work):
    for binary in (False, True):
        meshio.write(f"{work}/{name}_fluent{int(binary)}.msh", meshio.Mesh(m.points, cells),
                     file_format="ansys", binary=binary)
PY
for body in plate block; do
    check ${body}_by_corners same $body ${body}_fluent0 1e-14 none
    check ${body}_by_corners_binary same $body ${body}_fluent1 1e-14 none
done
{ cat "$work/plate_fluent0.msh"; echo '(45 (18 fluid inner)())'; echo '(45 (19 wall rim)())'; } >"$work/zones.msh"
check zones_are_named stops 0 "the zones inner, rim of a Fluent mesh make no sets" convert "$work/zones.msh"
echo "1..$count"
