# Shared by run and the scripts in this folder; source it with ROOT set to the top folder of the project.

# Another build folder: SLIPNAV_BUILD.
BUILD="${SLIPNAV_BUILD:-$ROOT/build}"
LOGS="$BUILD/log"

# The system's python3 has catkin and rospy; another one earlier in PATH may have neither.
export PATH="/usr/bin:$PATH"

# Lets nodes find each other on machines whose own name does not resolve.
if [[ -z "${ROS_IP:-}${ROS_HOSTNAME:-}" ]]; then
  export ROS_HOSTNAME=localhost
fi

say() { echo "slipnav: $*" >&2; }

# Ends with status 2, as for every wrong argument.
usage_error() {
  echo "run: $*" >&2
  exit 2
}

# step WHAT LOG COMMAND...: one line of progress, another of the time if it took long, the output into build/log/LOG; on
# failure the end of that log.
step() {
  local what="$1" log="$LOGS/$2" status=0 began="$SECONDS"
  shift 2
  mkdir -p "$LOGS"
  say "$what"
  "$@" >"$log" 2>&1 || status=$?
  if ((status != 0)); then
    tail -n 40 "$log" | cut -c 1-300 >&2
    say "$what: failed with status $status (all of it: ${log#"$PWD/"})"
  elif ((SECONDS - began >= 20)); then
    say "$what: done after $((SECONDS - began)) s"
  fi
  return "$status"
}

# As many compilers as cores and memory allow (about 1.5 GB each).
parallel_jobs() {
  local cores memory_kb by_memory
  cores="$(nproc)"
  memory_kb="$(awk '/^MemAvailable/ {print $2}' /proc/meminfo)"
  by_memory=$((memory_kb / 1500000))
  ((by_memory < 1)) && by_memory=1
  echo $((cores < by_memory ? cores : by_memory))
}

# source_setup FILE: the setup files of catkin read unset variables.
source_setup() {
  set +u
  source "$1"
  set -u
}

# ROS Noetic of packages.ros.org lives apart; that of Debian is part of the system.
enter_ros() {
  if [[ -f /opt/ros/noetic/setup.bash ]]; then
    source_setup /opt/ros/noetic/setup.bash
  fi
}

ensure_built() { "$ROOT/scripts/build"; }

enter_workspace() { source_setup "$BUILD/devel/setup.bash"; }

# Puts the arguments into ARGUMENTS, names of configurations (--config NAME, --sensor NAME, as for launch files) as files
# of config/.
name_configurations() {
  local argument previous=""
  ARGUMENTS=()
  for argument in "$@"; do
    if [[ "$previous" =~ ^--(config|sensor)$ && ! -e "$argument" && -f "$ROOT/config/$argument.yaml" ]]; then
      argument="$ROOT/config/$argument.yaml"
    fi
    ARGUMENTS+=("$argument")
    previous="$argument"
  done
}

# A free port: what is started here must not interfere with a running master.
free_port() { python3 -c 'import socket; s = socket.socket(); s.bind(("", 0)); print(s.getsockname()[1])'; }
