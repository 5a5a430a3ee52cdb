#!/usr/bin/env bash
# Robots that run ROS 1, through Debian's own master and rospy. Arguments: the folder of our executables, cases.
set -euo pipefail
cd "$(dirname "$0")/.."

packages=(python3-rospy python3-rosmaster python3-nav-msgs python3-sensor-msgs python3-geometry-msgs python3-tf2-msgs)
if ! /usr/bin/python3 -c 'import rospy, rosmaster, nav_msgs.msg, sensor_msgs.msg, tf2_msgs.msg' 2> /dev/null; then
    root=()
    [ "$(id -u)" = 0 ] || root=(sudo)
    "${root[@]}" apt-get update -qq
    "${root[@]}" apt-get install -y -qq --no-install-recommends "${packages[@]}" > /dev/null
fi
exec .ci/ros_check.py "$@"
