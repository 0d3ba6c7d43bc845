# `cmake --install`: the programs, and core/ as a package for others (find_package(tern); target tern::core).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
