"""Who includes whom: rooms, cycles, the two other engines of truth."""

import collections
import os

from tree import LAYERS, room_of, unit_of

MOST_UNITS = 30
# One subject, the torques of a motion, whose parts each other room needs.
LARGE_ROOMS = {"model/dynamics"}


def sources_lie_in_rooms(tree):
    """Every folder of sources is a room of the table."""
    for room in sorted({room_of(path) for path in tree.code()}):
        if room not in tree.rooms.names:
            yield f"{room}: holds sources and is no room of cmake/rooms.cmake"


def rooms_include_those_above(tree):
    """A room includes itself and rooms above it in the table."""
    for path in tree.code():
        room = room_of(path)
        if room not in tree.rooms.names:
            continue
        allowed = tree.rooms.may_use(room)
        if tree.rooms.sees_hidden.search(path):
            allowed = allowed | {"model/plant/hidden"}
        for quoted, name in tree.includes(path):
            if not quoted:
                continue
            if name not in tree.paths or not os.path.dirname(name):
                yield f"{path}: includes {name}: expected a path from the root"
            elif room_of(name) not in allowed:
                yield f"{path}: includes {name}: {room} may not use {room_of(name)}"


def only_the_plant_is_simbody(tree):
    """Simbody is the engine that shares no code with ours."""
    for path in tree.code():
        names = [name for _, name in tree.includes(path)]
        if room_of(path) != "model/plant" and any(
                name.startswith(("Simbody", "SimTK")) for name in names):
            yield f"{path}: includes Simbody: only model/plant may"


def _graph(tree):
    graph = collections.defaultdict(set)
    for path in tree.code():
        for quoted, name in tree.includes(path):
            if quoted and name.split("/")[0] in LAYERS and unit_of(name) != unit_of(path):
                graph[unit_of(path)].add(unit_of(name))
    return graph


def files_have_no_cycles(tree):
    """A header and its source are one unit; no unit needs itself."""
    graph, state, way = _graph(tree), {}, []

    def visit(unit):
        state[unit] = "open"
        way.append(unit)
        for other in sorted(graph.get(unit, ())):
            if state.get(other) == "open":
                cycle = way[way.index(other):]
                yield f"{min(cycle)}: a cycle of files: {' -> '.join(cycle + [other])}"
            elif other not in state:
                yield from visit(other)
        way.pop()
        state[unit] = "done"

    for unit in sorted(graph):
        if unit not in state:
            yield from visit(unit)


def rooms_are_not_crowded(tree):
    """A reader can know the units of a room by name."""
    units = collections.defaultdict(set)
    for path in tree.code():
        units[room_of(path)].add(unit_of(path))
    for room, members in sorted(units.items()):
        if len(members) > MOST_UNITS and room not in LARGE_ROOMS:
            yield f"{room}: {len(members)} units, at most {MOST_UNITS}: divide the room"


RULES = (sources_lie_in_rooms, rooms_include_those_above, only_the_plant_is_simbody,
         files_have_no_cycles, rooms_are_not_crowded)
