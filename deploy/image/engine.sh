# To be read by the scripts beside it: the container engine of this machine, or one that is installed for it.
#   engine ARGUMENT...       Docker or Podman
#   build_image ARGUMENT...  builds deploy/Dockerfile; the same sources give the same image
#   run_image ARGUMENT...    runs a container: read-only, without rights, with the machine's own network
#   base_image               prints the name of the Debian to build on, and has it ready; fails if there is none

say() { printf 'image: %s\n' "$*" >&2; }

limited=()  # what Podman wants to be told where it may not do everything
run_limits=()

choose_engine() {
  if docker info >/dev/null 2>&1; then
    engine=docker
    return
  fi
  engine=podman
  # A store of its own: what other containers of the machine are is not our business.
  mkdir -p build/image
  export CONTAINERS_STORAGE_CONF=$PWD/build/image/storage.conf
  printf '[storage]\ndriver = "overlay"\nrunroot = "%s"\ngraphroot = "%s"\n' "$PWD/build/image/run" "$PWD/build/image/store" \
    >"$CONTAINERS_STORAGE_CONF"
  if ! command -v podman >/dev/null; then
    ./run packages podman runc
  fi
  # Inside a container, or without systemd, Podman may make no cgroups and not raise its own limits.
  if [[ ! -d /run/systemd/system ]]; then
    limited=(--runtime runc --cgroup-manager cgroupfs)
    run_limits=(--ulimit nofile=4096:4096 --ulimit nproc=4096:4096)
    ./run packages runc
  fi
}

engine() {
  if [[ $engine == docker ]]; then docker "$@"; else podman "${limited[@]}" "$@"; fi
}

build_image() {
  # The time of the last change, and not that of the building, is what files and image bear.
  local epoch
  epoch=$(git log -1 --format=%ct 2>/dev/null || echo 0)
  if [[ $engine == docker ]]; then
    DOCKER_BUILDKIT=1 docker build --build-arg "SOURCE_DATE_EPOCH=$epoch" --file deploy/Dockerfile "$@" . >&2
  else
    # Packages come the way that this machine gets them, be it through a proxy; what it has compiled is not again.
    local compiled=()
    if command -v ccache >/dev/null; then compiled=(--volume "$(ccache -k cache_dir):/root/.cache/ccache"); fi
    podman build --isolation chroot --network host --format docker --layers --timestamp "$epoch" \
      --volume /etc/apt/apt.conf.d:/etc/apt/apt.conf.d:ro "${compiled[@]}" \
      --ignorefile deploy/Dockerfile.dockerignore --file deploy/Dockerfile "$@" . >&2
  fi
}

run_image() {
  engine run --network host --read-only --cap-drop all --security-opt no-new-privileges "${run_limits[@]}" "$@"
}

base_image() {
  local name=docker.io/library/debian:bookworm-slim own=localhost/debian:bookworm
  if engine image inspect "$own" >/dev/null 2>&1; then
    echo "$own"
  elif engine image inspect "$name" >/dev/null 2>&1 || timeout 60 "$engine" pull "$name" >/dev/null 2>&1; then
    echo "$name"
  else
    say "no image registry within reach: making Debian from this machine's package sources"
    ./run packages mmdebstrap
    { cat /etc/apt/sources.list /etc/apt/sources.list.d/*.list 2>/dev/null || true; } |
      mmdebstrap --quiet --variant=minbase --include=ca-certificates bookworm build/image/debian.tar \
        $(ls /etc/apt/sources.list.d/*.sources 2>/dev/null) - >&2 || return
    engine import build/image/debian.tar "$own" >/dev/null || return
    rm build/image/debian.tar
    echo "$own"
  fi
}

choose_engine
