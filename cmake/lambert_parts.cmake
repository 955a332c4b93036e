# The parts that can be built alone. Each asks for the packages of its own rooms only, so that a machine
# for workers needs neither tinygltf nor OpenEXR:
#   cmake -B build -DLAMBERT_BUILD_SERVER=OFF -DLAMBERT_BUILD_CLIENT=OFF -DLAMBERT_BUILD_BENCH=OFF
option(LAMBERT_BUILD_SERVER "The coordinator, lambert-server" ON)
option(LAMBERT_BUILD_WORKER "The worker, lambert-worker" ON)
option(LAMBERT_BUILD_CLIENT "The client library, and the command lambert, which holds all rooms" ON)
option(LAMBERT_BUILD_TESTS "The tests of what is built" ON)
option(LAMBERT_BUILD_BENCH "The benchmarks of shooting, where Google Benchmark is there" ON)

# The rooms of the parts that are wanted.
set(shooting radiosity/core radiosity/patch radiosity/pyramid radiosity/trace radiosity/exact
  radiosity/shoot)
set(telling radiosity/core telemetry)
set(serving ${shooting} radiosity/scene radiosity/solve proto net server)
set(working ${shooting} proto net worker)
set(LAMBERT_ROOMS radiosity/core)
if(LAMBERT_BUILD_SERVER)
  list(APPEND LAMBERT_ROOMS ${telling} ${serving})
endif()
if(LAMBERT_BUILD_WORKER)
  list(APPEND LAMBERT_ROOMS ${telling} ${working})
endif()
if(LAMBERT_BUILD_CLIENT)
  list(APPEND LAMBERT_ROOMS ${serving} ${working} radiosity/output client local app)
endif()
if(LAMBERT_BUILD_BENCH)
  list(APPEND LAMBERT_ROOMS ${shooting} tests/support bench)
endif()
if(LAMBERT_BUILD_TESTS)
  list(APPEND LAMBERT_ROOMS radiosity/patch tests/support examples tests)
endif()
list(REMOVE_DUPLICATES LAMBERT_ROOMS)
