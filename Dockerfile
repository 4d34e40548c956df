# strut as a package of Debian 12, and an image with it: docker build -t strut . && docker run -v $PWD:/work strut strut deck.xml
FROM debian:12 AS build
COPY . /src
WORKDIR /src
RUN apt-get update && apt-get install -y --no-install-recommends dpkg-dev file $(sed 's/ |.*//' tools/packages)
RUN cmake --preset portable -DBUILD_TESTING=OFF && cmake --build --preset portable && cd build/portable && cpack

FROM debian:12
COPY --from=build /src/build/portable/strut_*.deb /tmp/
RUN apt-get update && apt-get install -y --no-install-recommends /tmp/strut_*.deb python3-mpi4py && useradd strut
USER strut
WORKDIR /work
