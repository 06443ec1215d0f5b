#!/bin/sh
# In a bare Debian, with the packages in /packages: they install with what they need, the programs run, the units are
# where systemd looks, and what is removed leaves its settings behind as Debian's packages do.
set -e
apt-get update >/dev/null
DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends /packages/kcs_*.deb >/tmp/log 2>&1 ||
  { cat /tmp/log; exit 1; }
kcsd --version
kcs-gateway --version
kcsctl plan /data/zigzag.nc | head -n 3
for unit in kcsd.socket kcsd.service kcs-gateway@.service; do test -f "/lib/systemd/system/$unit"; done
kcsd --config /etc/kcs/kcsd.toml --listen 127.0.0.1:0 --database memory >/tmp/log 2>&1 &
server=$!
sleep 2
kill -TERM "$server"
wait "$server"
apt-get remove -y kcs >/dev/null 2>&1
test -f /etc/kcs/kcsd.toml
test ! -e /usr/bin/kcsd
echo "good: kcs installs, runs and is removed"
