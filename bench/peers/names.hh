/* names.hh -- from the name of a scene to its type. */
#ifndef BENCH_PEERS_NAMES_HH
#define BENCH_PEERS_NAMES_HH

#include <cstdio>
#include <cstdlib>
#include <string>

#include "scenes.hh"

/* What action(scene) returns; 2 if there is no such scene. */
template <class Action> int
with_scene(const std::string &name, Action action)
{
#define SCENE(word, ...)                                                                 \
    if (name == word)                                                                    \
        return action(__VA_ARGS__{});
    SCENE("pendulum", pendulum)
    SCENE("double", twofold)
    SCENE("kepler_polar", kepler_polar)
    SCENE("spherical_pole", spherical_pole)
    SCENE("stiff_spring", stiff_spring)
    SCENE("chain8", chain<8>)
    SCENE("chain16", chain<16>)
    SCENE("chain32", chain<32>)
    SCENE("chain64", chain<64>)
    SCENE("chain8_linear", chain_linear<8>)
    SCENE("chain16_linear", chain_linear<16>)
    SCENE("chain32_linear", chain_linear<32>)
    SCENE("chain64_linear", chain_linear<64>)
#undef SCENE
    std::fprintf(stderr, "there is no scene %s\n", name.c_str());
    return 2;
}

#endif
