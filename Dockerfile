# cubecam with its software renderer; the user is not root.
#
#   docker build --tag cubecam .
#   mkdir -p out && docker run --rm --user "$(id -u):$(id -g)" --volume "$PWD/out:/out" cubecam
#   docker run --rm cubecam doctor
#
# A GPU: --gpus all (NVIDIA), or --device /dev/dri --group-add "$(stat -c %g /dev/dri/renderD128)".

ARG BASE=debian:13-slim

FROM ${BASE} AS build
RUN apt-get update \
    && DEBIAN_FRONTEND=noninteractive apt-get install --yes --no-install-recommends \
        g++ libglm-dev libpython3-dev python3-venv \
    && rm -rf /var/lib/apt/lists/*
COPY . /source
RUN python3 -m venv /opt/tools \
    && /opt/tools/bin/pip wheel --quiet --no-deps --no-cache-dir --wheel-dir /wheels /source
# Extras of pyproject.toml, in brackets: --build-arg EXTRAS=[viewer,gltf]
ARG EXTRAS=""
RUN python3 -m venv --without-pip /opt/cubecam \
    && /opt/tools/bin/pip --python /opt/cubecam/bin/python install --quiet --no-cache-dir "$(echo /wheels/*.whl)${EXTRAS}"

# The same base, so that the environment finds the interpreter that made it.
FROM ${BASE}
RUN apt-get update \
    && DEBIAN_FRONTEND=noninteractive apt-get install --yes --no-install-recommends \
        libegl1 libegl-mesa0 libgl1-mesa-dri python3 \
    && rm -rf /var/lib/apt/lists/* \
    && useradd --create-home --uid 1000 cubecam \
    && mkdir --mode 1777 /out
COPY --from=build /opt/cubecam /opt/cubecam
# What cubecam keeps goes where any --user may write. "graphics" lets NVIDIA's runtime bring its EGL.
ENV PATH=/opt/cubecam/bin:$PATH \
    XDG_CACHE_HOME=/tmp/cache \
    NVIDIA_DRIVER_CAPABILITIES=compute,graphics,utility
USER 1000:1000
WORKDIR /out
ENTRYPOINT ["cubecam"]
CMD ["demo", "--out", "/out"]
