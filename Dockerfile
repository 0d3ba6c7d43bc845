# An image with the package tern: docs/howto/install.md. .ci/image builds it without Docker.
FROM debian:12 AS build
RUN apt-get update && apt-get install -y --no-install-recommends dpkg-dev debhelper
COPY . /tern
WORKDIR /tern
RUN apt-get build-dep -y --no-install-recommends ./
RUN dpkg-buildpackage -b -us -uc

FROM debian:12
COPY --from=build /tern_*.deb /tmp/
RUN apt-get update && apt-get install -y --no-install-recommends /tmp/tern_*.deb && rm -rf /tmp/tern_*.deb /var/lib/apt/lists/*
RUN useradd --create-home tern && mkdir /flights && chown tern /flights
USER tern
ENTRYPOINT ["tern"]
CMD ["fly"]
