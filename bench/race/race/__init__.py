"""A race of octrace against other ray tracers, on the same solids, with the same pictures."""
