// The headers that tests share are compiled beside this file (tests/CMakeLists.txt); it says nothing itself.
