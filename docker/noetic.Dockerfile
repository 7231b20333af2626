# slipnav on Ubuntu 20.04 with ROS Noetic from packages.ros.org:
#   docker build --file docker/noetic.Dockerfile --tag slipnav .
#   docker run --rm slipnav ./run test
FROM ubuntu:20.04

ENV DEBIAN_FRONTEND=noninteractive LANG=C.UTF-8
WORKDIR /slipnav

# The key comes from the archive itself, and is taken only if it is the one that ROS publishes.
ARG ROS_KEY=C1CF6E31E6BADE8868B172B4F42ED6FBAB17C654
ADD http://packages.ros.org/ros.key /tmp/ros.key
RUN apt-get update && apt-get install -y --no-install-recommends gnupg \
  && gpg --show-keys --with-colons /tmp/ros.key | grep -q "^fpr:.*:$ROS_KEY:" \
  && gpg --dearmor < /tmp/ros.key > /usr/share/keyrings/ros.gpg \
  && echo "deb [signed-by=/usr/share/keyrings/ros.gpg] http://packages.ros.org/ros/ubuntu focal main" \
    > /etc/apt/sources.list.d/ros.list \
  && apt-get update && apt-get install -y --no-install-recommends ros-noetic-ros-core

# Packages have their own layer, unaffected by code changes.
COPY scripts/setup scripts/common.sh scripts/
RUN scripts/setup && rm -rf build

COPY . .
RUN ./run build
CMD ["./run", "demo"]
