"""A sound document and all that differ from it in one place."""
import copy

ODD = (None, True, -1, 0.5, 1e300, "", "no", "x", [], [1], {}, {"x": 1})


def places(node, path=()):
    """Every key of every object and list below `node`."""
    items = node.items() if isinstance(node, dict) else enumerate(node) if isinstance(node, list) else ()
    for key, child in items:
        yield (*path, key)
        yield from places(child, (*path, key))


def changed(document, path, change):
    """A copy in which `change(parent, key)` was made at `path`."""
    result = copy.deepcopy(document)
    parent = result
    for key in path[:-1]:
        parent = parent[key]
    change(parent, path[-1])
    return result


def variations(document, odd=ODD):
    """The document; each value left out, replaced by each odd one; each object with a key that nobody knows."""
    yield document
    yield {**document, "unknown": 1}
    for path in list(places(document)):
        yield changed(document, path, lambda parent, key: parent.pop(key))
        for value in odd:
            yield changed(document, path, lambda parent, key: parent.__setitem__(key, copy.deepcopy(value)))
        yield changed(document, path,
                      lambda parent, key: parent[key].update(unknown=1) if isinstance(parent[key], dict) else None)
