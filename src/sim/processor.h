// Which processor a thread is on. Schedulers leave two threads that work for each other on one processor, now and then,
// and idle the next one: the one that is woken goes where it last was, or where its waker is, and if its turn comes
// whenever the other waits, nothing looks overloaded. On a machine of two processors that was seen to last for many
// steps, of which each took 15 times as long.
#pragma once

namespace clothlab::sim {

/// The processor that the calling thread is on; -1 where the system does not tell (it does on Linux, in a nanosecond).
int current_processor();

/// Moves the calling thread to another processor than this one, if it may use another; from then on it may be moved
/// like any other thread. Takes some microseconds.
void leave_processor(int processor);

} // namespace clothlab::sim
