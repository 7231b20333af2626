# slipnav on Debian 12, whose own archive has ROS 1:
#   docker build --file docker/debian.Dockerfile --tag slipnav .
#   docker run --rm slipnav ./run test
FROM debian:12

ENV DEBIAN_FRONTEND=noninteractive LANG=C.UTF-8
WORKDIR /slipnav

# Packages have their own layer, unaffected by code changes.
COPY scripts/setup scripts/common.sh scripts/
RUN apt-get update && scripts/setup && rm -rf build

COPY . .
RUN ./run build
CMD ["./run", "demo"]
