#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# kirsch-track and kirsch-plot on a drawn run: results, pictures, and each file missing or cut.
prefix=plot
. tests/cli/steps
run=$work/case
track() { "$build/kirsch-track" --output "$run" "$run/case.yaml"; }
plot() { "$build/kirsch-plot" --output "$run" "$run/case.yaml" "$@"; }

# Value of the summary within a tolerance.
near() { # name, wanted, tolerance
    awk -F, -v name="$1" -v wanted="$2" -v tolerance="$3" '
        $1 == name { seen = 1; got = $2; off = got - wanted; if (off < 0) off = -off }
        END { if (!seen || off > tolerance) {
                  print name ": got " got ", wanted " wanted ", tolerance " tolerance; exit 1 } }
    ' "$run/summary.csv"
}

# As in steps, and without a trace.
told() { # code, words, command...
    stops "$@" && ! grep -q "Traceback" "$work/stop"
}

is_png() { # name, least bytes
    file="$run/pictures/$1.png"
    [ "$(head -c 4 "$file" | tail -c 3)" = PNG ] && [ "$(wc -c <"$file")" -gt "$2" ]
}

# The crack starts at 20 us and takes 1.1 us for the first two cells of 0.25 mm.
tracks() { track && near branches 2 0 && near cracks 1 0 && near first_growth 20.55e-6 0.55e-6; }
# 11.5 mm and 13.5 mm at 450 m/s, and the arms, cut at 120 us: 20.4 mm at 495 m/s, 18.5 mm at 450 m/s.
# 464.4 m/s over the time of running, to 1 %.
speeds() { near mean_speed 464.4 4.6 && near rayleigh_speed 929 1; }
tells_tips() { head -n 1 "$run/tips.csv" |
    grep -qF 'time [s],branch,x [m],y [m],distance [m],speed [m/s],speed_error [m/s],speed_over_rayleigh,angle [deg],front_energy [J/m^2]'; }
# Through the hole under one number, then the fork; both arms run on.
tells_branches() {
    cut -d, -f1-4,16 "$run/branches.csv" >"$work/branches"
    printf '%s\n' branch,parent,start,end,pores 1,0,pre-crack,branch,1 2,1,branch,running, 3,1,branch,running, |
        diff - "$work/branches" &&
        printf '%s\n' kind birth 'enter hole' 'leave hole' branch branch >"$work/kinds" &&
        cut -d, -f2 "$run/events.csv" | diff "$work/kinds" -
}
# 5 us in the hole; the last damage before and the first behind it are up to a cell late, 0.55 us each
tells_trapped() {
    awk -F, '$1 == 1 { seen = 1; off = $14 - 5e-6; exit !(off > -1.1e-6 && off < 1.1e-6) }
             END { if (!seen) exit 1 }' "$run/branches.csv"
}
boxes() {
    "$build/kirsch-track" --output "$run" --set 'track.boxes=[{lower: [0 mm, 0 mm], upper: [30 mm, 25 mm], direction: +x}, {lower: [30 mm, 0 mm], upper: [50 mm, 12 mm], direction: +x}]' \
        "$run/case.yaml" && [ -s "$run/boxes.csv" ] && near tip_x_box_1 29.875e-3 2.5e-4 && near mean_speed_box_2 450 9
}
draws_all() {
    plot >"$work/paths" || return 1
    for picture in grid damage energy speed tip tree history; do
        is_png $picture 10000 || { echo "$picture.png is not as expected"; return 1; }
    done
    [ "$(wc -l <"$work/paths")" -eq 8 ] && [ -s "$run/pictures/crack.mp4" ]
}
draws_one() { [ "$(plot tip)" = "$run/pictures/tip.png" ]; }
draws_a_field() { plot --field Damage && is_png field-damage 10000 && [ "$(/usr/bin/python3 -c "
import sys, numpy as np
from PIL import Image
picture = Image.open(sys.argv[1])
print(round(picture.info['dpi'][0]), picture.size[0], np.asarray(picture.convert('L')).std() > 10)" "$run/pictures/field-damage.png")" = "300 2100 True" ]; }
draws_other_formats() {
    [ "$(plot tip --format svg)" = "$run/pictures/tip.svg" ] && grep -q '<svg' "$run/pictures/tip.svg" &&
        plot --field Damage --dpi 100 --limits 0.2,0.4 && is_png field-damage 3000 &&
        [ "$(/usr/bin/python3 -c "from PIL import Image; import sys; print(Image.open(sys.argv[1]).size[0])" \
            "$run/pictures/field-damage.png")" = 700 ]
}
compares_a_field() {
    "$build/kirsch-plot" compare "$run" "$run" --field Stored_Elastic_Energy_Density --at 60 >"$work/said" &&
        grep -q 'largest difference of stored elastic energy density (kJ/m³): 0$' "$work/said" &&
        is_png compare-stored_elastic_energy_density 10000
}
draws_components() {
    plot --field Stress.yy --field Velocity && is_png field-stress-yy 10000 && is_png field-velocity 10000 &&
        told 2 '`Stress`: expected a component, as Stress.zz; there are xx, xy, xz' plot --field Stress &&
        told 2 '`Damage.x`: expected a component' plot --field Damage.x
}
films_a_field() {
    rm -f "$run/pictures/film-stress-yy.mp4"
    [ "$(plot film --field Stress.yy)" = "$run/pictures/film-stress-yy.mp4" ] &&
        [ "$(ffprobe -v error -count_frames -show_entries stream=nb_read_frames -of csv=p=0 \
            "$run/pictures/film-stress-yy.mp4")" -eq 13 ] &&
        told 2 'film: expected the field to be filmed' plot film
}
# Pulled by 0.5 % of its height and opened by 4 mm times 0.005: at a scale of 20 the map is higher by 2.9 mm.
draws_moved_cells() {
    plot strip && cp "$run/pictures/strip.png" "$work/still.png" && plot strip --scale 20 &&
        /usr/bin/python3 - "$work/still.png" "$run/pictures/strip.png" <<'END'
import sys, numpy as np
from PIL import Image
still, moved = (np.asarray(Image.open(f).convert("L")).astype(int) for f in sys.argv[1:])
# a map is (7 - 0.5 - 0.75 - 2 * 0.3)/3 inches wide: so many pixels a mm, at 300 dots an inch
pixels = (7 - 0.5 - 0.75 - 2 * 0.3) / 3 * 300 / 50
higher = len(moved) - len(still)
assert abs(higher - pixels * 20 * 0.005 * (25 + 4)) < 3, (higher, pixels)
END
}
draws_the_tree() { plot tree && is_png tree 10000; }
# A film and a picture that are not done: nothing stands under their names but what stood there before.
killed_film() {
    mkdir -p "$work/odd" && mkdir -p "$run/pictures" && echo before >"$run/pictures/crack.mp4" || return
    printf '#!/bin/sh\nfor last; do :; done\necho half >"$last"\necho $$ >"%s"\nkill -9 $PPID\nexec sleep 600\n' \
        "$work/odd/pid" >"$work/odd/ffmpeg" && chmod +x "$work/odd/ffmpeg"
    env PATH="$work/odd:$PATH" "$build/kirsch-plot" --output "$run" "$run/case.yaml" crack
    [ $? = 137 ] || return
    [ "$(cat "$run/pictures/crack.mp4")" = before ] || return
    for wait in $(seq 200); do # ffmpeg is ended with the program that feeds it
        kill -0 "$(cat "$work/odd/pid")" 2>/dev/null || return 0
        sleep 0.05
    done
    kill -9 "$(cat "$work/odd/pid")"
    return 1
}
picture_on_a_full_disk() {
    mkdir -p "$run/pictures" && echo before >"$run/pictures/tip.png" &&
        (ulimit -f 8 && told 3 'File too large' plot tip) && [ "$(cat "$run/pictures/tip.png")" = before ]
}
without_ffmpeg() { # a PATH on which there is none
    told 0 'warning: no film: cannot start ffmpeg' env PATH="$work" "$build/kirsch-plot" \
        --output "$run" "$run/case.yaml" tip crack
}
without_tips() { # the others are drawn all the same
    mv "$run/tips.csv" "$work/tips.csv"
    told 2 'no picture `speed`: .*tips.csv is missing' plot speed history
    result=$?
    mv "$work/tips.csv" "$run/tips.csv"
    [ $result -eq 0 ] && grep -q 'history.png' "$work/stop"
}
cut_run() {
    cp "$run/run.h5" "$work/whole.h5"
    truncate -s 100000 "$run/run.h5"
    told 2 'run.h5: it is cut short or damaged' track &&
        told 2 'run.h5: .*cut short or damaged' plot damage
    result=$?
    cp "$work/whole.h5" "$run/run.h5"
    return $result
}
# A copy of the run changed by a line of Python, and put back.
with_run() { # change of f, command...
    cp "$run/run.h5" "$work/whole.h5"
    /usr/bin/python3 -B -c "import sys, h5py
with h5py.File(sys.argv[1], 'a') as f: $1" "$run/run.h5"
    shift
    "$@"
    result=$?
    cp "$work/whole.h5" "$run/run.h5"
    track
    return $result
}
# Nothing, or everything at once, is damaged: sentences, not traces, and the maps all the same.
sees_nothing() {
    told 0 'none: no damage past the threshold' track && rm -rf "$run/pictures" &&
        told 0 'no picture `tip`: there is no crack tip' plot && told 0 'no picture `tree`' plot tree &&
        is_png damage 10000 && is_png history 10000 && [ ! -e "$run/pictures/tip.png" ]
}
sees_all() {
    told 0 'not to be counted: 100 % of all nodes' track && rm -rf "$run/pictures" &&
        told 0 'no picture `speed`: there is no crack tip' plot && is_png damage 10000 && is_png energy 10000
}
one_snapshot="
  for k in sorted(f['step'])[1:]: del f['step'][k]"
# The first alone: all times asked for come after it.
sees_one_output() {
    track && rm -rf "$run/pictures" && told 0 'crack.mp4' plot &&
        for picture in grid damage energy speed tip tree history; do is_png $picture 10000 || return; done
}
no_snapshot="
  for k in sorted(f['step']): del f['step'][k]"
sees_no_output() {
    told 0 'fragments have no momentum' track && told 2 'run.h5 holds no output yet' plot damage
}
no_gaps() { # every pixel of the plate belongs to a cell, and none of the hole does
    PYTHONPATH="$build" /usr/bin/python3 -B - "$run/plate.nodes.h5" <<'END'
import sys, h5py, numpy as np
from raster import raster
with h5py.File(sys.argv[1]) as f:
    point, first, vertex = (f["cells/" + n][:] for n in ("point", "first", "vertex"))
for columns in (77, 640, 2001):
    rows = columns // 2
    cell = raster(point, first, vertex, point.min(axis=0), point.max(axis=0), (rows, columns))
    x, y = np.meshgrid((np.arange(columns) + 0.5) / columns * 50e-3, (np.arange(rows) + 0.5) / rows * 25e-3)
    r = np.hypot(x - 15e-3, y - 12.5e-3)
    gaps, filled = (cell[r > 1.5e-3] < 0).sum(), (cell[r < 1.49e-3] >= 0).sum()
    assert gaps == 0 and filled == 0, (columns, gaps, filled)
END
}

/usr/bin/python3 -B tests/cli/synthetic.py "$run" 0.25 12 || echo "not ok 1 - the drawn run"
track >"$work/said" 2>&1
check track_counts_branches tracks
check track_measures_speed speeds
check track_writes_tips tells_tips
check tree_of_the_drawn_run tells_branches
check tree_tells_time_in_holes tells_trapped
check track_uses_boxes boxes
track >"$work/said" 2>&1
check draws_all_pictures draws_all
check draws_one_picture draws_one
check draws_a_field draws_a_field
check draws_components draws_components
check films_a_field films_a_field
check draws_moved_cells draws_moved_cells
check refuses_slices_of_a_plate told 2 'a plate has no slices' plot damage --slice 'z=1 mm'
check draws_the_tree draws_the_tree
check draws_other_formats draws_other_formats
check compares_a_field compares_a_field
check refuses_limits_upside_down told 2 'limits: found .2,1., expected the lower one first' plot --field Damage --limits 2,1
check refuses_an_option_without_its_value told 2 'dpi: expected a value behind it, as --dpi 150' plot damage --dpi
check refuses_an_unknown_option told 2 'unknown option `--colour`' plot damage --colour red
check refuses_a_wrong_time told 2 'at: found `soon`, expected a time in us' "$build/kirsch-plot" compare "$run" "$run" --at soon
check refuses_an_unknown_field told 2 'unknown field `Damge`; the run has Damage' plot --field Damge
check refuses_an_unknown_picture told 2 'unknown picture `dammage`' plot dammage
check goes_on_without_ffmpeg without_ffmpeg
check film_whose_making_is_killed killed_film
check picture_on_a_full_disk picture_on_a_full_disk
check goes_on_without_tips without_tips
check tells_a_cut_run cut_run
check tells_that_nothing_broke with_run "f['crack/Damage_Time'][:] = float('inf')" sees_nothing
check tells_that_everything_broke with_run "f['crack/Damage_Time'][:] = 4e-6" sees_all
check draws_a_single_output with_run "$one_snapshot" sees_one_output
check tells_a_run_without_output with_run "$no_snapshot" sees_no_output
check fills_every_pixel no_gaps
check refuses_an_unknown_argument told 2 'unknown' "$build/kirsch-track" "$run/case.yaml" --fast
echo "1..$count"
