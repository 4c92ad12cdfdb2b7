// Only test cases tagged [threads] can start threads: the thread sanitizer runs these and no others. Sanitizers put
// their own pthread_create in front of the system's, so that the other builds have to check this.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

#include <algorithm>
#include <atomic>
#include <catch2/catch_test_case_info.hpp>
#include <catch2/reporters/catch_reporter_event_listener.hpp>
#include <catch2/reporters/catch_reporter_registrars.hpp>
#include <cerrno>
#include <iostream>

#include <dlfcn.h>
#include <pthread.h>

namespace {

std::atomic<bool> may_start_threads{true};

class ThreadsAreTagged : public Catch::EventListenerBase {
public:
    using EventListenerBase::EventListenerBase;

    void testCaseStarting(const Catch::TestCaseInfo& test) override {
        may_start_threads = std::find(test.tags.begin(), test.tags.end(), Catch::Tag("threads")) != test.tags.end();
    }
    void testCaseEnded(const Catch::TestCaseStats&) override { may_start_threads = true; }
};

CATCH_REGISTER_LISTENER(ThreadsAreTagged)

} // namespace

/// In front of the system's, which std::thread calls; std::thread throws what this returns.
extern "C" int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*call)(void*),
                              void* argument) noexcept {
    if (!may_start_threads) {
        std::cerr << "This test case starts a thread: tag it [threads]\n";
        return EPERM;
    }
    static const auto system_s = reinterpret_cast<decltype(&pthread_create)>(::dlsym(RTLD_NEXT, "pthread_create"));
    return system_s(thread, attributes, call, argument);
}

#endif
