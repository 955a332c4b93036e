# A Slurm of three nodes on this machine. To be sourced: start_slurm DIR, start_node NAME, kill_node
# NAME, stop_slurm. Needs root, and the Debian packages below. All that it writes is in DIR.
slurm_packages=(slurmctld slurmd slurm-client slurm-wlm-basic-plugins munge python3)

# free_ports N: that many ports of 127.0.0.1 that nobody listens on.
free_ports() {
  python3 - "$1" <<'PYTHON'
import socket, sys
sockets = [socket.create_server(("127.0.0.1", 0)) for _ in range(int(sys.argv[1]))]
print(*(s.getsockname()[1] for s in sockets))
PYTHON
}

# start_slurm DIR: DIR is absolute, and may be read by everyone. Returns when all nodes are idle.
start_slurm() {
  slurm_dir=$1
  export SLURM_CONF=$slurm_dir/slurm.conf
  mkdir -p "$slurm_dir"/{munge,run,log,state,spool/n1,spool/n2,spool/n3}
  local host ports script
  host=$(hostname -s)
  read -ra ports < <(free_ports 4)
  script="s#@DIR@#$slurm_dir#g;s#@HOST@#$host#g"
  for i in 0 1 2 3; do script+=";s#@PORT$i@#${ports[i]}#g"; done
  sed "$script" "$(dirname "${BASH_SOURCE[0]}")/slurm.conf.in" >"$SLURM_CONF"

  chmod 755 "$slurm_dir" "$slurm_dir/munge"
  dd if=/dev/urandom of="$slurm_dir/munge/key" bs=128 count=1 status=none
  chmod 400 "$slurm_dir/munge/key"
  chown -R munge:munge "$slurm_dir/munge"
  setpriv --reuid=munge --regid=munge --clear-groups munged --socket="$slurm_dir/munge/socket" \
    --key-file="$slurm_dir/munge/key" --pid-file="$slurm_dir/munge/munged.pid" \
    --log-file="$slurm_dir/munge/munged.log" --seed-file="$slurm_dir/munge/munged.seed"
  slurmctld -f "$SLURM_CONF" -c
  for node in n1 n2 n3; do start_node "$node"; done
  local tries=0
  until [[ $(sinfo -h -N -t idle -o %N 2>/dev/null | wc -l) == 3 ]]; do
    ((++tries < 300)) || { sinfo -N -l; return 1; }
    sleep 0.1
  done
}

start_node() { slurmd -c -f "$SLURM_CONF" -N "$1"; }

# kill_node NAME: as a power cut does: the node's daemon, the steps that it watches, and their programs,
# which are known by their environment.
kill_node() {
  kill -KILL "$(cat "$slurm_dir/run/slurmd.$1.pid")"
  local environment id parent
  for environment in /proc/[0-9]*/environ; do
    grep -qszxF "SLURMD_NODENAME=$1" "$environment" || continue
    grep -qszxF "SLURM_CONF=$SLURM_CONF" "$environment" || continue
    id=${environment//[!0-9]/}
    parent=$(awk '/^PPid:/ { print $2 }' "/proc/$id/status")
    # The step first: it would tell how its program ended.
    if [[ $(cat "/proc/$parent/comm") == slurmstepd ]]; then kill -KILL "$parent"; fi
    kill -KILL "$id"
  done
  # Slurm itself would notice after SlurmdTimeout.
  scontrol update nodename="$1" state=down reason="lost its power"
}

stop_slurm() {
  scancel --user=root 2>/dev/null || true
  local tries=0 id
  while [[ -n $(squeue -h 2>/dev/null) ]] && ((++tries < 150)); do sleep 0.1; done
  timeout 10 scontrol shutdown >/dev/null 2>&1 || true
  for tries in {1..50}; do
    compgen -G "$slurm_dir/run/*.pid" >/dev/null || break
    sleep 0.1
  done
  for id in $(cat "$slurm_dir"/run/*.pid "$slurm_dir/munge/munged.pid" 2>/dev/null); do
    kill -KILL "$id" 2>/dev/null || true
  done
}
