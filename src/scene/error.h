// What is wrong with a scene, as a sentence with its place.
#pragma once

#include <stdexcept>
#include <string>

namespace clothlab::scene {

/// what() reads "FILE:LINE: KEY: what is wrong; what is allowed", with the parts that are known.
class SceneError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

} // namespace clothlab::scene
