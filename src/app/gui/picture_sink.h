// Where the pictures of a recording go: a film, or files one by one.
#pragma once

#include "render/image.h"

namespace clothlab::app {

class PictureSink {
public:
    virtual ~PictureSink() = default;

    /// Adds the next picture. Throws std::runtime_error with the file and the reason when it cannot be kept.
    virtual void add(const render::Image& picture) = 0;
    /// Makes what was added complete; the last call. Throws std::runtime_error when that cannot be done.
    virtual void finish() = 0;
    /// Removes what was written; the last call.
    virtual void discard() = 0;
};

} // namespace clothlab::app
