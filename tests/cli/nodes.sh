#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# kirsch-nodes on files of other programs (gmsh, meshio, netCDF4): volumes and named sets survive; what
# it writes is read back by them; faults stop with a sentence.
prefix=nodes
. tests/cli/steps
python=/usr/bin/python3

convert() {
    "$build/kirsch-nodes" --convert "$@" --output "$work"
}

# Convert a file; its node file must hold this volume and these sets, each NAME:COUNT[:MEASURE].
gives() { # file, volume, sets...
    file=$1
    shift
    convert "$work/$file" || return 1
    $python - "$work/${file%.*}.nodes.h5" "$@" <<'PY'
import sys
import h5py
path, volume, *sets = sys.argv[1:]
with h5py.File(path) as f:
    got = f["nodes/volume"][:].sum()
    assert abs(got - float(volume)) < 1e-12 * abs(got), f"volume {got}"
    for text in sets:
        name, count, *measure = text.split(":")
        assert name in f["sets"], f"no set {name}: {list(f['sets'])}"
        rows = f["sets"][name]
        assert len(rows) == int(count), f"{name}: {len(rows)} nodes, wanted {count}"
        if measure:
            length = rows.attrs["measure"]
            assert abs(length - float(measure[0])) < 1e-12, f"{name}: measure {length}"
    assert len(f["sets"]) == len(sets), list(f["sets"])
PY
}

# A plate of 4 x 3 squares and 12 triangles, and a block of 24 hexahedra and 24 wedges.
cat >"$work/plate.geo" <<'GEO'
Point(1)={0,0,0,.3}; l[]=Extrude{1,0,0}{Point{1}; Layers{4};};
s[]=Extrude{0,1,0}{Curve{l[1]}; Layers{3}; Recombine;};
t[]=Extrude{1,0,0}{Curve{s[2]}; Layers{2};};
Physical Surface("both",70)={s[1],t[1]}; Physical Surface("squares",3)={s[1]};
Physical Curve("bottom",11)={l[1]};
GEO
cat >"$work/block.geo" <<'GEO'
Point(1)={0,0,0,.4}; l[]=Extrude{1,0,0}{Point{1}; Layers{4}; Recombine;};
s[]=Extrude{0,1,0}{Curve{l[1]}; Layers{3}; Recombine;};
v[]=Extrude{0,0,1}{Surface{s[1]}; Layers{2}; Recombine;};
t[]=Extrude{1,0,0}{Curve{s[2]}; Layers{2};};
w[]=Extrude{0,0,1}{Surface{t[1]}; Layers{2}; Recombine;};
Physical Volume("hex",100)={v[1]}; Physical Volume("all",6)={v[1],w[1]};
Physical Surface("floor",1)={s[1],t[1]};
GEO
for format in msh41 inp unv; do
    gmsh -2 "$work/plate.geo" -format $format -o "$work/plate.${format%41}" >"$work/log" 2>&1
    gmsh -3 "$work/block.geo" -format $format -o "$work/block.${format%41}" >"$work/log" 2>&1
    cp "$work/plate.${format%41}" "$work/p_$format.${format%41}"
    cp "$work/block.${format%41}" "$work/b_$format.${format%41}"
done
check msh_plate gives p_msh41.msh 2 both:24 squares:12 bottom:4:1
check msh_block gives b_msh41.msh 2 all:48 hex:24 floor:24:2
check inp_plate_of_gmsh gives p_inp.inp 2 both:24 squares:12 bottom:4:1 Surface5:12 Surface9:12 Line1:4:1
check inp_block_of_gmsh gives b_inp.inp 2 all:48 hex:24 floor:24:2 Surface5:12:1 Surface31:12:1 \
    Volume1:24 Volume2:24
check unv_plate gives p_unv.unv 2 both:24 squares:12 bottom:4:1
check unv_block gives b_unv.unv 2 all:48 hex:24 floor:24:2

# Abaqus by hand: ranges, sets of sets, sets in two blocks, names in any case, gaps, a reference point.
cat >"$work/hand.inp" <<'INP'
*Heading
** two squares and two triangles of side 2
*NODE, NSET=EVERY
 10, 0., 0.
 20, 2., 0.
 30, 4., 0.
 40, 0., 2.
 50, 2., 2.
 60, 4., 2.
 70, 6., 0.
 80, 6., 2.
*Node
 999, 9., 9.
*Element, type=CPS4R, elset=Quads
 7, 10, 20, 50, 40
 9, 20, 30, 60, 50
*Element, type=CPS3, elset=Tris
 100, 30, 70, 60
 104, 70, 80, 60
*Nset, nset=Left
 10, 40
*Nset, nset=Floor, generate
 10, 30, 10
*Nset, nset=Floor
 70
*Elset, elset=Mixed
 9, 104
*Elset, elset=All
 Quads, TRIS
*Elset, elset=Left
 7
*Nset, nset=Point
 50
INP
check inp_sets_by_hand gives hand.inp 12 Quads:2 Tris:2 Mixed:2 All:4 Left:1 Left_boundary:1:2 \
    Floor:3:6 Point:2 EVERY:4:16
check inp_orphan_is_named stops 0 "the first is point 999 at (9, 9, 0) m" convert "$work/hand.inp"
sed 's/^ 9, 104/ 9, 105/' "$work/hand.inp" >"$work/bad.inp"
check inp_unknown_element stops 2 "the set 'Mixed' has the element 105" convert "$work/bad.inp"
sed 's/CPS4R/XYZ4/' "$work/hand.inp" >"$work/bad.inp"
check inp_unknown_type stops 2 "elements of type XYZ4 are not read" convert "$work/bad.inp"
sed 's/^ 100, 30/ 100, 31/' "$work/hand.inp" >"$work/bad.inp"
check inp_unknown_node stops 2 "an element has the node 31" convert "$work/bad.inp"
{ printf '*Instance, name=a, part=b\n 1., 0., 0.\n'; cat "$work/hand.inp"; } >"$work/bad.inp"
check inp_instance_of_no_part stops 2 "names the part 'B', which is nowhere defined" convert "$work/bad.inp"

# Two instances of a bar of two squares: one as it is, one turned by 90 degrees about z and moved; sets of the
# part, of the assembly, and surfaces by element set and by element.
cat >"$work/instances.inp" <<'INP'
*Part, name=Bar
*Node
 1, 0., 0.
 2, 2., 0.
 3, 4., 0.
 4, 0., 1.
 5, 2., 1.
 6, 4., 1.
*Element, type=CPS4, elset=Cells
 1, 1, 2, 5, 4
 2, 2, 3, 6, 5
*Nset, nset=End
 1, 4
*Surface, name=Low
 Cells, S1
*End Part
*Assembly, name=A
*Instance, name=One, part=Bar
*End Instance
*Instance, name=Two, part=Bar
 6., 1., 0.
 6., 1., 0., 6., 1., 1., 90.
*End Instance
*Node
 1, 50., 50.
*Nset, nset=Reference
 1
*Nset, nset=Ends, instance=One
 End,
*Nset, nset=Ends, instance=Two
 3, 6
*Elset, elset=Firsts
 One.1, Two.1
*Elset, elset=Whole
 One.Cells, Two.Cells
*Surface, type=ELEMENT, name=Tops
 One.Cells, S3
 Two.2, S2
*End Assembly
INP
check inp_instances gives instances.inp 8 One_Cells:2 Two_Cells:2 One_End:1:1 Two_End:1:1 One_Low:2:4 \
    Two_Low:2:4 Ends:2:2 Firsts:2 Whole:4 Tops:3:5
instances_stand() {
    $python - "$work/instances.nodes.h5" <<'PY'
import sys
import h5py, numpy as np
with h5py.File(sys.argv[1]) as f:
    x = f["nodes/position"][:]
want = np.array([[1, .5], [3, .5], [5.5, 2], [5.5, 4]])
assert np.abs(x[np.lexsort(x.T)] - want[np.lexsort(want.T)]).max() < 1e-12, x
PY
}
check inp_instances_stand instances_stand
sed 's/One.Cells, S3/One.Cells, S7/' "$work/instances.inp" >"$work/bad.inp"
check inp_face_not_read stops 0 "has the face 'S7', which is not read" convert "$work/bad.inp"
sed 's/One.Cells, S3/One.Cells, S5/' "$work/instances.inp" >"$work/bad.inp"
check inp_face_too_high stops 2 "has the face S5 of element 1, a quad" convert "$work/bad.inp"
# The faces of a hexahedron by their numbers: a box of 1 x 2 x 4.
{
    printf '*NODE\n1,0,0,0\n2,1,0,0\n3,1,2,0\n4,0,2,0\n5,0,0,4\n6,1,0,4\n7,1,2,4\n8,0,2,4\n'
    printf '*ELEMENT, TYPE=C3D8R, ELSET=BOX\n1,1,2,3,4,5,6,7,8\n'
    for k in 1 2 3 4 5 6; do printf '*SURFACE, NAME=F%s\nBOX, S%s\n' $k $k; done
} >"$work/faces.inp"
check inp_faces gives faces.inp 8 BOX:1 F1:1:2 F2:1:2 F3:1:4 F4:1:8 F5:1:4 F6:1:8

# ANSYS: a brick and, in its notation, a wedge, a pyramid and a tetrahedron, in columns that touch; components
# with a range; blanks and a missing z at the ends of lines.
cat >"$work/bodies.cdb" <<'CDB'
/COM,ANSYS RELEASE
ET,        1,185
ET,        2,187
NBLOCK,6,SOLID,        12,        12
(3i9,6e21.13e3)
        1        0        0
        2        0        0 1.0000000000000E+000
        3        0        0 1.0000000000000E+000 1.0000000000000E+000
        4        0        0 0.0000000000000E+000 1.0000000000000E+000
        5        0        0 0.0000000000000E+000 0.0000000000000E+000 1.0000000000000E+000
        6        0        0 1.0000000000000E+000 0.0000000000000E+000 1.0000000000000E+000
        7        0        0 1.0000000000000E+000 1.0000000000000E+000 1.0000000000000E+000
        8        0        0 0.0000000000000E+000 1.0000000000000E+000 1.0000000000000E+000
       20        0        0 2.0000000000000E+000
       21        0        0 2.0000000000000E+000 0.0000000000000E+000 1.0000000000000E+000
123456789        0        0 5.0000000000000E-001 5.0000000000000E-001 2.0000000000000E+000
       30        0        0 1.0000000000000E+000-1.0000000000000E+000
N,R5.3,LOC,       -1,
EBLOCK,19,SOLID,         5,         5
(19i9)
        1        1        1        1        0        0        0        0        8        0       11        1        2        3        4        5        6        7        8
        1        1        1        1        0        0        0        0        8        0       12        2       20        3        3        6       21        7        7
        2        1        1        1        0        0        0        0        8        0       13        5        6        7        8123456789123456789123456789123456789
        2        1        1        1        0        0        0        0        8        0       14        2       30       20       20        6        6        6        6
       -1
CMBLOCK,FLOOR   ,NODE,       2
(8i10)
         1        -4
CMBLOCK,HEADS   ,ELEM,       3  ! a remark
(8i10)
        11       -12        14
CDB
sed -i 's/^EBLOCK,19,SOLID,         5,         5/EBLOCK,19,SOLID,        14,         4/' "$work/bodies.cdb"
# 1 + 1/2 + 1/3 + 1/6.
check cdb_bodies gives bodies.cdb 2 FLOOR:1:1 HEADS:3 material_1:2 material_2:2
sed 's/^ET,        1,185/ET,1,200/' "$work/bodies.cdb" >"$work/bad.cdb"
check cdb_unknown_type stops 2 "element 11 is of ANSYS's type 200 with 8 nodes" convert "$work/bad.cdb"
sed 's/SOLID,        14/,        14/' "$work/bodies.cdb" >"$work/bad.cdb"
check cdb_no_solid stops 2 "an EBLOCK is not of the kind SOLID" convert "$work/bad.cdb"
sed '/^       20  /d' "$work/bodies.cdb" >"$work/bad.cdb"
check cdb_unknown_node stops 2 "element 12 has the node 20, which NBLOCK does not hold" convert "$work/bad.cdb"
# In the plane, second order on two lines: an 8-node quadrilateral and a triangle in its notation.
cat >"$work/plane.cdb" <<'CDB'
ET,1,PLANE183
ET,1,183
NBLOCK,6,SOLID
(3i8,6e16.9)
       1       0       0 0.000000000E+00
       2       0       0 2.000000000E+00
       3       0       0 2.000000000E+00 2.000000000E+00
       4       0       0 0.000000000E+00 2.000000000E+00
       5       0       0 1.000000000E+00
       6       0       0 2.000000000E+00 1.000000000E+00
       7       0       0 1.000000000E+00 2.000000000E+00
       8       0       0 0.000000000E+00 1.000000000E+00
       9       0       0 4.000000000E+00
      10       0       0 3.000000000E+00
      11       0       0 3.000000000E+00 1.000000000E+00
N,R5.3,LOC,       -1,
EBLOCK,10,SOLID
(15i8)
       1       1       1       1       0       0       0       0       8       0       1       1       2       3       4
       5       6       7       8
       1       1       1       1       0       0       0       0       8       0       2       2       9       3       3
      10      11       3       6
      -1
CMBLOCK,RIGHT,ELEM,1
(8i10)
         2
CDB
check cdb_plane gives plane.cdb 6 RIGHT:1

# What meshio writes, and an Exodus file with side sets and named blocks by netCDF4.
PYTHONPATH=tests/cli $python -B - "$work" <<'PY' >"$work/log" 2>&1
import sys
import meshio, netCDF4, numpy as np
from by_meshio import bodies
work = sys.argv[1]
for name, m, cells in bodies(work):
    data = {"Material": [np.full(len(d), 3 + k) for k, (_, d) in enumerate(cells)]}
    for end in ("vtu", "vtk", "xdmf", "bdf", "avs"):
        meshio.write(f"{work}/{name}_m.{end}", meshio.Mesh(m.points, cells, cell_data=data))
    floor = np.flatnonzero(m.points[:, 1 if name == "plate" else 2] == 0)
    med = meshio.Mesh(m.points, cells, point_data={"point_tags": np.isin(np.arange(len(m.points)), floor) * 2},
                      cell_data={"cell_tags": [np.full(len(d), -6 - k) for k, (_, d) in enumerate(cells)]})
    med.point_tags = {2: ["floor"]}
    med.cell_tags = {-6: ["first", "all"], -7: ["all"]}
    meshio.write(f"{work}/{name}_m.med", med)
with netCDF4.Dataset(f"{work}/hexes.e", "w", format="NETCDF3_64BIT_OFFSET") as nc:
    for key, n in dict(num_nodes=12, num_dim=3, num_elem=2, num_el_blk=2, num_node_sets=1, num_side_sets=1,
                       len_name=33, num_el_in_blk1=1, num_el_in_blk2=1, num_nod_per_el1=8,
                       num_nod_per_el2=8, num_nod_ns1=4, num_side_ss1=2).items():
        nc.createDimension(key, n)
    p = np.array([(x, y, z) for z in (0., 1.) for y in (0., 1.) for x in (0., 1., 2.)])
    for d, axis in enumerate("xyz"):
        nc.createVariable("coord" + axis, "f8", ("num_nodes",))[:] = p[:, d]
    for k in (1, 2):
        v = nc.createVariable(f"connect{k}", "i4", (f"num_el_in_blk{k}", f"num_nod_per_el{k}"))
        v.elem_type = "HEX8"
        v[:] = np.array([[0, 1, 4, 3, 6, 7, 10, 9]]) + k
    for key, dim, ids in (("eb_prop1", "num_el_blk", [10, 20]), ("ns_prop1", "num_node_sets", [5]),
                          ("ss_prop1", "num_side_sets", [8])):
        nc.createVariable(key, "i4", (dim,))[:] = ids
    names = nc.createVariable("eb_names", "S1", ("num_el_blk", "len_name"))
    names[0, :5] = np.frombuffer(b"steel", "S1")
    nc.createVariable("node_ns1", "i4", ("num_nod_ns1",))[:] = [1, 4, 7, 10]
    nc.createVariable("elem_ss1", "i4", ("num_side_ss1",))[:] = [1, 2]
    nc.createVariable("side_ss1", "i4", ("num_side_ss1",))[:] = [6, 6]
PY
for end in vtu vtk xdmf; do
    check ${end}_plate gives plate_m.$end 2 Material_3:12 Material_4:12
    check ${end}_block gives block_m.$end 2 Material_3:24 Material_4:24
done
check med_plate gives plate_m.med 2 first:12 all:24 floor:6:2
check med_block gives block_m.med 2 first:24 all:48 floor:24:2
check avs_plate gives plate_m.avs 2 material_3:12 material_4:12
check nastran_plate gives plate_m.bdf 2
check nastran_block gives block_m.bdf 2
check exodus_block gives hexes.e 2 steel:1 block_20:1 nodeset_5:1:1 sideset_8:2:2

# Bodies of CAD, in millimetres, through gmsh.
cat >"$work/cad.geo" <<'GEO'
SetFactory("OpenCASCADE"); Box(1) = {0, 0, 0, 20, 10, 10};
GEO
gmsh -0 "$work/cad.geo" -format step -o "$work/cad.step" >"$work/log" 2>&1
cat >"$work/case.yaml" <<'DECK'
geometry: {width: 2 m, height: 1 m}
mesh: {spacing: 5 mm}
nodes: {horizon: 20 mm, surface_correction: none}
material: {model: plane-stress, youngs_modulus: 1 GPa, density: 1000 kg/m3}
solver: {end_time: 1 us}
DECK
"$build/kirsch-gmsh" --body step 0.005 <"$work/cad.step" 4<"$work" >"$work/log" 2>&1
check step_in_metres sh -c "'$build/kirsch-nodes' --convert '$work/body.part.msh' --output '$work' | grep -q 'volume 2000 mm^3'"
# gmsh's cells can hang on where it allocates, and so on its path, its folder and its arguments: a program in the place
# of kirsch-gmsh shows that none of them are the user's, and the cells are the same wherever the programs lie.
wherever_the_programs_lie() {
    for folder in bin a/folder/with/a/much/longer/name; do
        mkdir -p "$work/$folder/out" && cp "$build/kirsch-nodes" "$build/kirsch-gmsh" "$work/cad.step" "$work/$folder" &&
            (cd "$work/$folder" && ./kirsch-nodes --output out --set material.model=solid cad.step "$work/case.yaml") &&
            cmp "$work/$folder/out/cad.converted.msh" "$work/bin/out/cad.converted.msh" || return
        printf '#!/bin/sh\necho "Error   : called as $0 $* in $PWD" >&2\nexit 1\n' >"$work/$folder/kirsch-gmsh"
        stops 2 'cad.step: called as /proc/self/fd/3 --body step 0.0050*1* in /$' \
            "$work/$folder/kirsch-nodes" --output "$work/$folder/out" "$work/cad.step" "$work/case.yaml" || return
    done
}
check step_wherever_the_programs_lie wherever_the_programs_lie
check step_needs_a_spacing stops 2 "mesh.spacing" convert "$work/cad.step"
check solids_need_a_model stops 2 "is a mesh of solids" "$build/kirsch-nodes" "$work/b_msh41.msh" \
    "$work/case.yaml" --output "$work/out"

# Writing: Exodus by netCDF4, VTU by meshio, text by ourselves.
written() {
    convert "$work/b_msh41.msh" --write peridigm,exodus,vtu,inp,csv || return 1
    convert "$work/p_msh41.msh" --write vtu,dat,peridigm --thickness "10 mm" || return 1
    $python - "$work" <<'PY'
import sys
import h5py, meshio, netCDF4, numpy as np
work = sys.argv[1]
with h5py.File(f"{work}/b_msh41.nodes.h5") as f:
    volume, position = f["nodes/volume"][:], f["nodes/position"][:]
    floor = f["sets/floor"][:]
    f_first, f_vertex = f["cells/first"][:], f["cells/vertex"][:]
vtu = meshio.read(f"{work}/b_msh41.vtu")
assert {c.type: len(c.data) for c in vtu.cells} == {"hexahedron": 24, "wedge": 24} or \
    sum(len(c.data) for c in vtu.cells) == 48
assert np.allclose(np.concatenate(vtu.cell_data["Volume"]).sum(), 2, atol=1e-13)
assert np.concatenate(vtu.cell_data["floor"]).sum() == len(floor)
inp = meshio.read(f"{work}/b_msh41.inp")
assert {c.type: len(c.data) for c in inp.cells} == {"hexahedron": 24, "wedge": 24}
corners = np.unique(np.concatenate([f_vertex[a:b] for a, b in zip(f_first[floor], f_first[floor + 1])]))
assert np.array_equal(np.sort(inp.point_sets["floor"]), corners)
with netCDF4.Dataset(f"{work}/b_msh41.e") as nc:
    assert nc["connect1"].elem_type == "SPHERE"
    assert np.array_equal(nc["attrib1"][:, 1], volume)
    assert np.array_equal(nc["coordx"][:], position[:, 0])
    names = [b"".join(n.filled(b"")).decode().strip("\0") for n in nc["ns_names"][:]]
    assert np.array_equal(nc[f"node_ns{names.index('floor') + 1}"][:], floor + 1)
text = np.loadtxt(f"{work}/b_msh41.txt")
assert np.array_equal(text[:, 3], volume) and np.array_equal(text[:, :3], position)
assert np.array_equal(np.loadtxt(f"{work}/b_msh41_ns_floor.txt", dtype=int), floor + 1)
plate = np.loadtxt(f"{work}/p_msh41.txt")
assert abs(plate[:, 3].sum() - 0.02) < 1e-15, plate[:, 3].sum()
assert len(np.loadtxt(f"{work}/nodes.dat")) == 24
PY
}
check what_is_written_is_read written
round_trip() {
    convert "$work/b_msh41.msh" --write csv || return 1
    cp "$work/b_msh41.csv" "$work/again.csv"
    gives again.csv 2 body:48 all:48 hex:24 floor:24 block_1:48
}
check csv_round_trip round_trip
# Points with volumes in Exodus, as Peridigm keeps them: what we write, we read.
spheres() {
    convert "$work/b_msh41.msh" --write exodus || return 1
    cp "$work/b_msh41.e" "$work/spheres.e"
    gives spheres.e 2 body:48 all:48 hex:24 floor:24 block_1:48
}
check exodus_spheres spheres
# The same through every other format that keeps cells or volumes: volumes, sets and places as they were.
same_nodes() { # node files of two conversions, sets, format
    $python - "$@" <<'PY'
import sys
import h5py, numpy as np
one, two = [h5py.File(name) for name in sys.argv[1:3]]
def table(f):
    x = f["nodes/position"][:]
    return x, np.lexsort(np.round(x, 9).T), f["nodes/volume"][:]
(x, p, v), (y, q, w) = table(one), table(two)
assert len(p) == len(q), (len(p), len(q))
# Texts have 17 digits, but Abaqus's 13, which is all that CalculiX reads of a number.
digits = 1e-12 if sys.argv[4] == "inp" else 1e-15
assert np.abs(x[p] - y[q]).max() < 2 * digits and np.abs(v[p] - w[q]).max() < digits
rank = np.empty(len(p), int), np.empty(len(q), int)
rank[0][p] = rank[1][q] = np.arange(len(p))
for name in sys.argv[3].split():
    a, b = sorted(rank[0][one["sets"][name][:]]), sorted(rank[1][two["sets"][name][:]])
    assert a == b, f"{name}: {len(a)} and {len(b)} nodes"
assert sys.argv[4] != "vtu" or sorted(two["sets"]) == sorted(sys.argv[3].split()), list(two["sets"])
if sys.argv[4] == "vtu":
    assert (one["nodes/tag"][:][p] == two["nodes/tag"][:][q]).all()
PY
}
there_and_back() { # NAME FORMAT SETS ENDING [SET FILE...]
    convert "$work/$1.msh" --write "$2" || return 1
    cp "$work/$1.nodes.h5" "$work/there.h5"
    case "$2" in dat) from=$work/nodes.dat ;; *) from=$work/$1.$4 ;; esac
    cp "$from" "$work/back.$4"
    body=$1 format=$2 sets=$3 back=$work/back.$4
    shift 4
    for set in "$@"; do back="$back $work/${body}_ns_$set.txt"; done
    # shellcheck disable=SC2086
    convert $back || return 1
    same_nodes "$work/there.h5" "$work/back.nodes.h5" "$sets" "$format"
}
check vtu_round_trip there_and_back b_msh41 vtu "all hex floor" vtu
check vtu_round_trip_plane there_and_back p_msh41 vtu "both squares bottom" vtu
check inp_round_trip there_and_back b_msh41 inp "all hex floor" inp
check inp_round_trip_plane there_and_back p_msh41 inp "both squares bottom" inp
check peridigm_round_trip there_and_back b_msh41 peridigm "all hex floor" txt all hex floor
check dat_round_trip there_and_back p_msh41 dat "" dat
# Wedges as VTK has them, the normal of the first triangle outwards, or ParaView takes them for inside out.
wedges_of_vtk() {
    convert "$work/b_msh41.msh" --write vtu || return 1
    $python - "$work/b_msh41.vtu" <<'PY'
import re, sys
import numpy as np
data = open(sys.argv[1], "rb").read()
at = data.index(b"\n_", data.index(b"<AppendedData")) + 2
def array(name):
    kind, offset = re.search(rb'type="(\w+)" Name="%s"[^>]*offset="(\d+)"' % name, data).groups()
    start = at + int(offset)
    size = int(np.frombuffer(data, "<u8", 1, start)[0])
    return np.frombuffer(data[start + 8:start + 8 + size],
                         {b"Float64": "<f8", b"Int64": "<i8", b"UInt8": "u1"}[kind])
points, cells = array(b"Points").reshape(-1, 3), array(b"connectivity")
ends, types = array(b"offsets"), array(b"types")
wedges = [points[cells[end - 6:end]] for end, kind in zip(ends, types) if kind == 13]
assert len(wedges) == 24
for p in wedges:
    assert np.dot(np.cross(p[1] - p[0], p[2] - p[0]), p[3:].mean(0) - p[:3].mean(0)) < 0
PY
}
check vtu_wedges wedges_of_vtk

# Peers' faults, on meshes that gmsh made irregular: one kind of cell read of two, vertex means for centroids,
# volumes shared out to vertices, groups of plane cells passed over, numbers taken to have no gaps. Areas, volumes
# and centroids against those worked out here: polygons as triangles, hexahedra by Gauss points of their map.
cat >"$work/mixed.geo" <<'GEO'
SetFactory("OpenCASCADE");
Rectangle(1)={0,0,0,2,1}; Disk(2)={.7,.5,0,.3}; BooleanDifference(3)={Surface{1}; Delete;}{Surface{2}; Delete;};
Mesh.CharacteristicLengthMax=.17; Mesh.RecombinationAlgorithm=0; Mesh.RecombineMinimumQuality=.6;
Recombine Surface{3}; Physical Surface("plate",70)={3}; Physical Curve("hole",12)={5};
GEO
cat >"$work/warped.geo" <<'GEO'
Point(1)={0,0,0,.3}; l[]=Extrude{1,0,0}{Point{1}; Layers{5}; Recombine;};
s[]=Extrude{0,1,0}{Curve{l[1]}; Layers{5}; Recombine;};
v[]=Extrude{{0.3,0.2,1},{2,0.3,0.1},{-1.2,-.4,.2},0.9}{Surface{s[1]}; Layers{6}; Recombine;};
Physical Volume("hex",100)={v[1]}; Physical Surface("floor",1)={s[1]};
GEO
gmsh -2 "$work/mixed.geo" -format msh41 -o "$work/mixed.msh" >"$work/log" 2>&1
gmsh -3 "$work/warped.geo" -format msh41 -o "$work/warped.msh" >"$work/log" 2>&1
as_worked_out() { # NAME
    convert "$work/$1.msh" || return 1
    $python - "$work/$1" <<'PY'
import itertools, sys
import h5py, meshio, numpy as np
mesh = meshio.read(sys.argv[1] + ".msh")
def polygon(p):
    a = [np.cross(p[k] - p[0], p[k + 1] - p[0])[2] / 2 for k in range(1, len(p) - 1)]
    c = [(p[0] + p[k] + p[k + 1]) / 3 for k in range(1, len(p) - 1)]
    return sum(a), sum(x * y for x, y in zip(a, c)) / sum(a)
corner = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)])
def hexahedron(p):  # three Gauss points an axis are exact
    volume, moment = 0, np.zeros(3)
    gauss = [(.5 - np.sqrt(.15), 5 / 18), (.5, 4 / 9), (.5 + np.sqrt(.15), 5 / 18)]
    for (x, a), (y, b), (z, c) in itertools.product(gauss, repeat=3):
        t = np.where(corner == 1, (x, y, z), 1 - np.array((x, y, z)))
        shape = t.prod(1)
        slope = np.array([np.where(corner[:, d] == 1, 1, -1) * np.delete(t, d, 1).prod(1) for d in range(3)])
        weight = a * b * c * np.linalg.det(slope @ p)
        volume, moment = volume + weight, moment + weight * (shape @ p)
    return volume, moment / volume
rule = {"triangle": polygon, "quad": polygon, "hexahedron": hexahedron}
solid = "hexahedron" in mesh.cells_dict
want, mean = [], []
for kind, rows in mesh.cells_dict.items():
    if kind in rule and (kind == "hexahedron") == solid:
        want += [rule[kind](mesh.points[row]) for row in rows]
        mean += [mesh.points[row].mean(0) for row in rows]
kinds = [k for k in mesh.cells_dict if k in rule and (k == "hexahedron") == solid]
assert len(kinds) == (1 if solid else 2), kinds
with h5py.File(sys.argv[1] + ".nodes.h5") as f:
    x, v, sets = f["nodes/position"][:], f["nodes/volume"][:], {k: len(f["sets"][k]) for k in f["sets"]}
dim = x.shape[1]
centre = np.array([c for _, c in want])[:, :dim]
assert len(x) == len(want), (len(x), len(want))
pair = [int(np.argmin(((x - c) ** 2).sum(1))) for c in centre]
assert sorted(pair) == list(range(len(x)))
# The rule of the faces makes volumes those of the map; a fan's centroid is off by the square of how far it is bent.
assert np.abs(x[pair] - centre).max() < (1e-7 if solid else 1e-13), np.abs(x[pair] - centre).max()
assert np.abs(v[pair] - [abs(a) for a, _ in want]).max() < 1e-15
far = np.abs(np.array(mean)[:, :dim] - centre).max()
assert far > 1e-3, far
assert sets == ({"hex": 150, "floor": 25} if solid else {"plate": len(x), "hole": sets["hole"]}), sets
print(f"# figure {len(x)} cells, vertex means off by {far:.2g} at most")
PY
}
check irregular_plate as_worked_out mixed
check warped_hexahedra as_worked_out warped

# Bodies that reach into each other and share no point, as gmsh leaves them where nobody fragments.
cat >"$work/two.geo" <<'GEO'
SetFactory("OpenCASCADE"); Box(1)={0,0,0,1,1,1}; Box(2)={.8,.3,.3,1,1,1};
Mesh.CharacteristicLengthMax=.4; Physical Volume("body")={1,2};
GEO
gmsh -3 "$work/two.geo" -format msh41 -o "$work/two.msh" >"$work/log" 2>&1
check solids_that_overlap stops 2 "cells [0-9]* and [0-9]* overlap by .* m^3 at" convert "$work/two.msh"
check overlaps_are_not_repaired stops 2 "overlap by .* m^3 at" convert "$work/two.msh" --repair

check unit sh -c "'$build/kirsch-nodes' --convert '$work/p_msh41.msh' --output '$work' --unit mm | grep -q 'area 2 mm^2'"

# Faults.
check no_such_file stops 2 "cannot be read: No such file" convert "$work/none.vtu"
check no_format stops 2 "--write: found 'stl'" convert "$work/p_msh41.msh" --write stl
check no_unit stops 2 "--unit: found 'kg'" convert "$work/p_msh41.msh" --unit kg
check unknown_option stops 2 "--mend" convert "$work/p_msh41.msh" --mend
check two_meshes stops 2 "expected one mesh" convert "$work/p_msh41.msh" "$work/b_msh41.msh"
# Any file cut at any place: a sentence and exit 2, never a crash.
cut_files() { # file
    size=$(stat -c %s "$work/$1")
    for k in 1 2 3 4 5 6; do
        head -c $((k * size / 7)) "$work/$1" >"$work/cut.${1##*.}"
        convert "$work/cut.${1##*.}" >"$work/cut.log" 2>&1
        code=$?
        # Abaqus's files have no end: one cut behind its cells is a smaller mesh, and looked at askance.
        if [ $code -eq 0 ] && grep -q 'does not end with a whole line' "$work/cut.log"; then
            continue
        fi
        if [ $code -ne 2 ]; then
            echo "$1 cut at $k/7 ended with $code"
            cat "$work/cut.log"
            return 1
        fi
    done
}
for file in p_unv.unv plate_m.vtu hexes.e plate_m.med p_inp.inp bodies.cdb plate_m.vtk plate_m.xdmf; do
    check cut_${file##*.} cut_files $file
done
echo "1..$count"
