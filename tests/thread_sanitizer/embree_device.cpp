// Embree's devices for tests with the thread sanitizer and for the command that they run, and for nothing else: they
// build on the thread that commits.
//
// Embree builds with tasks of a TBB that is not built for the sanitizer. Their callbacks are our code, and everything
// that these read was written by the thread that commits, so each hand-over looks like a race; whether it is reported
// depends on whether a thread of TBB's happened to take part. The threads that tests make themselves remain.

#include <dlfcn.h>

#include <string>

extern "C" __attribute__((visibility("default"))) void* rtcNewDevice(const char* config) {
    using NewDevice = void* (*)(const char*);
    static const auto embree = reinterpret_cast<NewDevice>(::dlsym(RTLD_NEXT, "rtcNewDevice"));
    const std::string given = config ? config : "";
    return embree((given + (given.empty() ? "threads=1" : ",threads=1")).c_str());
}
