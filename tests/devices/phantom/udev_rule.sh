#!/bin/sh
# What udev itself makes of data/60-calligraphy.rules: udev_rule.sh RULES_FILE
# In a mount namespace of its own, with that file as the only rule, on devices that umockdev describes. Skipped (77) where
# a program is missing or the namespace is not permitted.
set -eu
rules=$1

if [ -z "${CALLIGRAPHY_UDEV_TEST_INSIDE:-}" ]; then
  for program in udevadm umockdev-run unshare; do
    command -v "$program" > /dev/null && continue
    echo "$program is missing: it is needed to let udev read its rule" >&2
    if [ -n "${CALLIGRAPHY_REQUIRE_DATA:-}" ]; then exit 1; fi
    exit 77
  done
  user=
  [ "$(id -u)" = 0 ] || user=--map-root-user
  if ! unshare $user --mount true 2> /dev/null; then
    echo "a mount namespace is not permitted here" >&2
    exit 77
  fi
  CALLIGRAPHY_UDEV_TEST_INSIDE=1 exec unshare $user --mount "$0" "$rules"
fi

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cp "$rules" "$work/60-calligraphy.rules"
mount -t tmpfs tmpfs /run  # udev's database, which a test run writes
mkdir -p /run/udev/rules.d
# The lowest of udev's directories are those of the distribution: without them its own rules have no say here.
for directory in /usr/lib/udev/rules.d /lib/udev/rules.d /usr/local/lib/udev/rules.d /etc/udev/rules.d; do
  [ ! -d "$directory" ] || mount -t tmpfs tmpfs "$directory"
done
cp "$work/60-calligraphy.rules" /run/udev/rules.d/

# describe VENDOR PRODUCT: a device with an interface, and below that a hidraw and a tty node.
describe() {
  cat << END
P: /devices/usb1/1-2
E: DEVNAME=/dev/bus/usb/001/002
E: DEVTYPE=usb_device
E: SUBSYSTEM=usb
A: idVendor=$1
A: idProduct=$2

P: /devices/usb1/1-2/1-2:1.0
E: DEVTYPE=usb_interface
E: SUBSYSTEM=usb

P: /devices/usb1/1-2/1-2:1.0/hidraw/hidraw0
E: SUBSYSTEM=hidraw
E: DEVNAME=/dev/hidraw0

P: /devices/usb1/1-2/1-2:1.0/tty/ttyACM0
E: SUBSYSTEM=tty
E: DEVNAME=/dev/ttyACM0

END
}

bus=/sys/devices/usb1/1-2
hidraw=$bus/1-2:1.0/hidraw/hidraw0
tty=$bus/1-2:1.0/tty/ttyACM0
failed=0

# expect yes|no VENDOR PRODUCT NODE ACTION: whether the rule gives the node to whoever sits at the computer.
expect() {
  describe "$2" "$3" > "$work/device"
  rm -rf /run/udev/data /run/udev/tags  # what it remembers of the device before
  umockdev-run -d "$work/device" -- udevadm test --action="$5" "$4" > "$work/said" 2>&1 || true
  given=no
  if grep -q 'MODE 0660$' "$work/said" && grep -q '^TAGS=.*:uaccess:' "$work/said" &&
    grep -q '^ID_MM_DEVICE_IGNORE=1$' "$work/said"; then
    given=yes
  fi
  # Where it gives nothing, none of the three is there, and what was said shows that the device was seen at all.
  if [ $given = no ] && grep -q 'MODE 0660\|:uaccess:\|ID_MM_DEVICE_IGNORE' "$work/said"; then given=half; fi
  grep -q "^DEVPATH=${4#/sys}\$" "$work/said" || given=unseen
  # A rule that udev does not understand is told of with file and line, and left out.
  if grep 'rules:[0-9]* .*\(Invalid\|Unknown\|ignoring\|unexpected\|rror\)' "$work/said" >&2; then given=misread; fi
  [ "$given" = "$1" ] && return 0
  echo "$2:$3 $4 on $5: given is $given, expected $1" >&2
  failed=1
}

for ids in "2988 0302" "0301 2988" "2988 0304"; do
  expect yes $ids "$bus" add
  expect yes $ids "$bus" change
  expect no $ids "$bus" remove
  expect no $ids "$bus/1-2:1.0" add
done
expect yes 2988 0304 "$hidraw" add
expect yes 2988 0302 "$tty" add
expect yes 0301 2988 "$tty" add
for ids in "046d c077" "2988 0305" "0301 0302"; do  # a mouse, a stranger of the same maker, halves of two
  for node in "$bus" "$hidraw" "$tty"; do expect no $ids "$node" add; done
done
exit $failed
