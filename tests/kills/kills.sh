#!/usr/bin/env bash
# Kills commands at random moments, and checks that nothing is lost or left half:
#   tests/kills/kills.sh PROGRAM FOLDER KILLS SEED [CASE...]
# For each case, runs the command once undisturbed, and then KILLS times with kill -9 at a random
# moment, followed by the same command, which must end with the same bytes. Prints a row per case:
# how many of the killed runs had finished, could be resumed (they left something that the second
# run uses) or left no results, and how many second runs failed or gave other bytes. Exit code 1 if
# any did. FOLDER takes the files; those of a failure stay there.
set -euo pipefail

if (($# < 4)); then
  sed -n '2,/^set/{/^set/d;s/^# \{0,1\}//;p}' "$0"
  exit 2
fi
program=$(realpath "$1") folder=$2 kills=$3 RANDOM=$4
shift 4
samples=$(realpath "$(dirname "$0")/../../samples")
cases=("$@")
((${#cases[@]})) || cases=(convert-fast convert compare pareto paper)
mkdir -p "$folder"
cd "$folder"

body=(--unit dm --up z --materials "$samples/dumbbell_materials.lua")

# Runs a case with its results below folder $2.
run() {
  local out=$2
  mkdir -p "$out"
  case $1 in
    convert-fast) set -- convert "$samples/dumbbell.obj" "${body[@]}" --fast -o "$out/a.glb" ;;
    convert) set -- convert "$samples/dumbbell.obj" "${body[@]}" --cell 10cm -o "$out/a.glb" ;;
    convert-small) set -- convert box.obj --cell 25cm --unit m -o "$out/a.glb" ;;
    compare) set -- compare asset.glb --scenario drop.lua --starts 3 \
      --frames 20 --out "$out/o" ;;
    pareto) set -- pareto asset.glb --scenario drop.lua --quick \
      --errors frequencies,loads,surface --out "$out/o" ;;
    paper) set -- paper --quick --variants LOD-b --out "$out/o" ;;
    *) echo "kills.sh: unknown case $1" >&2 && exit 2 ;;
  esac
  exec "$program" "$@" >"$out.out" 2>"$out.err"
}

prepare() {
  cat >box.obj <<'OBJ'
v 0 0 0
v 3 0 0
v 0 1 0
v 3 1 0
v 0 0 1
v 3 0 1
v 0 1 1
v 3 1 1
f 1 3 4 2
f 5 6 8 7
f 1 2 6 5
f 3 7 8 4
f 1 5 7 3
f 2 4 8 6
OBJ
  cat >drop.lua <<'LUA'
return {name = "drop", duration = 0.4, throw = {velocity = {1, 0, 0}},
        obstacles = {{name = "floor", plane = {0, 0, 1, -0.05}, friction = 0.4}}}
LUA
  "$program" -q convert box.obj --cell 34cm --unit m --fast -o asset.glb >prepare.out
}

# Results that hold measured times, the mark of the run, which holds the number of the process, and
# the command, which names the folder.
times='/timings(-[a-z]+)?\.csv$|/runs(-[a-z-]+)?\.csv$|/plan\.json$|/(results|logs)/|/\.springlod-run$'
times+='|^\./o/index\.html$|^\./o/(frequencies|loads|surface|surface-over-time|ensemble)(-front)?\.(csv|svg|png|gp)$'

# The hash and name of each file of folder $1 but those with times.
list() { (cd "$1" && find . -type f | sort | grep -Ev "$times" | xargs -r sha256sum); }

now() { date +%s.%N; }

# $1 seconds times $2 / 32768.
moment() { awk -v most="$1" -v r="$2" 'BEGIN {printf "%.3f", most * r / 32768}'; }

failures=0
printf '%-14s %6s %9s %10s %8s %8s\n' case kills finished resumable absent failed
prepare
for case in "${cases[@]}"; do
  declare -i finished=0 resumable=0 absent=0 failed=0
  rm -rf "$case-whole"
  begun=$(now)
  (run "$case" "$case-whole") || { cat "$case-whole.err" && exit 1; }
  took=$(awk -v a="$begun" -v b="$(now)" 'BEGIN {print b - a}')
  list "$case-whole" >"$case-whole.list"
  for ((kill = 1; kill <= kills; kill++)); do
    out=$case-$kill
    rm -rf "$out"
    run "$case" "$out" &
    process=$!
    random=$RANDOM # in a subshell it would be another one
    sleep "$(moment "$took" "$random")"
    kill -9 $process 2>/dev/null || true
    wait $process 2>/dev/null && finished+=1
    mv "$out.err" "$out.killed.err"
    (run "$case" "$out") && ended=0 || ended=$?
    list "$out" >"$out.list"
    if grep -q "resumes from\|continuing an unfinished" "$out.err"; then
      resumable+=1
    else
      absent+=1
    fi
    if ((ended == 0)) && cmp -s "$case-whole.list" "$out.list"; then
      rm -rf "$out" "$out".*
    else
      failed+=1
    fi
  done
  absent=$((absent - finished))
  failures=$((failures + failed))
  printf '%-14s %6d %9d %10d %8d %8d\n' "$case" "$kills" $finished $resumable $absent $failed
done
((failures == 0))
