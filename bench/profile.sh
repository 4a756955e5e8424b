#!/bin/sh
# Prints the table of docs/internals/performance.md: which share of the instructions of a fuzzer's worker each stage
# takes, and how many thousands that are for a frame. Counts do not change with the load of the machine, as times do.
#
# bench/profile.sh BUILD_FOLDER [CASES]    needs valgrind, and a build with -DCONTORT_BENCH=ON
set -eu
program=$1/bench/contort_profile_bench
cases=${2:-100}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# Of the functions whose names begin with this, which do not call each other.
stage() {
  awk -v name="$1" -v pattern="$2" -v frames="$frames" '
    NR == 1 { next }
    $0 ~ "PROGRAM TOTALS" && !all { all = $1; gsub(",", "", all) }
    $0 ~ pattern { count = $1; gsub(",", "", count); sum += count }
    END { printf "| %s | %.1f %% | %.2f |\n", name, 100 * sum / all, sum / frames / 1000 }' "$folder/inclusive"
}

print_table() {
  frames=$(valgrind --tool=callgrind --callgrind-out-file="$folder/counts" "$program" "$1" "$2" "$cases" \
    2>"$folder/log" | sed 's/ .*//')
  callgrind_annotate --inclusive=yes --threshold=100 "$folder/counts" >"$folder/inclusive"
  printf '\n%s, %s: %s frames of %s cases\n\n| stage | share | thousands for a frame |\n|---|---|---|\n' \
    "$1" "$2" "$frames" "$cases"
  stage "everything" ":main \["
  stage "drawing the spec" "contort::draw_spec\("
  stage "building the stage" "contort::build_stage\(contort::Spec const&, contort::Library"
  stage "generating, without dynamics" "Generation::run\("
  stage "– rules of actions" "contort::RuleRunner::run\("
  stage "– keeping limbs clear" "contort::LimbKeeper::finish\("
  stage "– room of limbs, for both" "contort::LimbRoom::(apart_m|touches)\("
  stage "– following at joints' speeds" "contort::JointPath::follow\("
  stage "simulating" "contort::simulate\("
  stage "placing the joints of frames" "contort::place_frames\("
  stage "checks" "contort::Judge::fold\("
  for check in self_collision ground_penetration foot_slide joint_range angular_velocity angular_acceleration; do
    stage "– $check" "contort::${check}_measure\("
  done
}

print_table tame human
print_table nightly human
print_table nightly mech
print_table nightly quadruped
