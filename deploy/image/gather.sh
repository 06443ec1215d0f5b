#!/usr/bin/env bash
# Puts the programs of a build, and all that they need to run, into a new folder that is to be the root of an image:
#   deploy/image/gather.sh BUILD FOLDER
# The same build gives the same files with the same times, whenever it is done.
set -euo pipefail
build=$1
root=$2

mkdir -p "$root"/{etc/kcs,etc/ssl/certs,usr/bin,tmp,var/lib/kcs}
for program in server/kcsd client/cli/kcsctl client/gateway/kcs-gateway; do
  install -s -m 755 "$build/$program" "$root/usr/bin/"
done

# The libraries that the loader would take, and the loader, each where the programs look for it.
ldd "$root"/usr/bin/* | grep -o '/[^ :]*\.so[^ ]*' | sort -u | while read -r library; do
  install -D -m 755 "$(readlink -f "$library")" "$root$library"
done

# Names for the user that it runs as; addresses from the hosts file first, then from DNS; the usual roots for TLS.
echo 'kcs:x:65532:65532:kcs:/var/lib/kcs:/none' >"$root/etc/passwd"
echo 'kcs:x:65532:' >"$root/etc/group"
echo 'hosts: files dns' >"$root/etc/nsswitch.conf"
cp /etc/ssl/certs/ca-certificates.crt "$root/etc/ssl/certs/"
cp deploy/kcsd.toml deploy/gateway.toml "$root/etc/kcs/"
cp LICENSE "$root/"
chown 65532:65532 "$root/var/lib/kcs"
chmod 1777 "$root/tmp"
chmod 700 "$root/var/lib/kcs"

find "$root" -exec touch --no-dereference --date=@0 {} +
