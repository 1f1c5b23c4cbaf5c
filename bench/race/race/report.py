"""The race in tables."""

from __future__ import annotations


def markdown(results: list[dict], about: dict) -> str:
    """Rates, ratios, times to the first picture, and how far pictures differ."""
    names = [program["program"] for program in results[0]["programs"]]
    blocks = [
        f"{about['date']}, {about['machine']}; {about['versions']}. One thread, 1024x768, medians of {about['repeat']}"
        " rounds, processor time.",
        "Camera rays in millions a second:",
        table(["scene", "primitives", *names], [rates(r, names, "mrays_per_s") for r in results]),
        "octrace's rate over theirs (below 1, octrace loses):",
        table(["scene", *names[1:]], [ratios(r, names, "mrays_per_s") for r in results]),
        "Shadow rays in millions a second, from every hit that faces the first light:",
        table(["scene", "octrace", "Embree", "ratio"], [shadows(r) for r in results]),
        "Seconds from the file, or the numbers it is made of, to the first picture:",
        table(["scene", *names, "ahead of the best by"], [first_pictures(r, names) for r in results]),
        "Share of pixels that differ from octrace's picture (mask / distance / normal):",
        table(["scene", *names[1:]], [differences(r, names) for r in results]),
    ]
    frames = [whole_frame(r) for r in results if r["whole_frame"]]
    if frames:
        head = ["scene", "octrace s", "POV-Ray s", "ratio", "rays in millions", "pixels that differ"]
        blocks += ["Whole frames, with all lights, shadows, mirrors and glass:", table(head, frames)]
    notes = sorted({f"{p['program']}: {p['note']}" for r in results for p in r["programs"] if p["note"]})
    blocks.append("\n".join(f"- {note}" for note in notes))
    return "\n\n".join(blocks) + "\n"


def table(heads: list[str], rows: list[list[str]]) -> str:
    lines = [heads, ["---"] + ["---:"] * (len(heads) - 1), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def by_name(result: dict) -> dict[str, dict]:
    return {program["program"]: program for program in result["programs"]}


def short(value: float | None) -> str:
    if value is None:
        return "-"
    return f"{value:.0f}" if value >= 100 else f"{value:.3g}"


def rates(result: dict, names: list[str], key: str) -> list[str]:
    programs = by_name(result)
    return [result["scene"], f"{result['primitives']:,}", *(short(programs[name][key]) for name in names)]


def ratios(result: dict, names: list[str], key: str) -> list[str]:
    programs = by_name(result)
    ours = programs[names[0]][key]
    theirs = (programs[name][key] for name in names[1:])
    return [result["scene"], *(short(ours / value if value else None) for value in theirs)]


def shadows(result: dict) -> list[str]:
    programs = by_name(result)
    ours, theirs = (programs.get(name, {}).get("shadow_mrays_per_s") for name in ("octrace", "Embree"))
    return [result["scene"], short(ours), short(theirs), short(ours / theirs if ours and theirs else None)]


def first_pictures(result: dict, names: list[str]) -> list[str]:
    programs = by_name(result)
    seconds = [programs[name]["first_picture_s"] for name in names]
    best = min((value for value in seconds[1:] if value is not None), default=None)
    ahead = best / seconds[0] if best is not None else None
    return [result["scene"], *map(short, seconds), short(ahead)]


def differences(result: dict, names: list[str]) -> list[str]:
    programs = by_name(result)

    def words(difference: dict | None) -> str:
        if difference is None:
            return "-"
        shares = (difference[key] for key in ("mask", "distance", "normal"))
        return " / ".join("-" if share is None else f"{share * 100.0:.2g} %" for share in shares)

    return [result["scene"], *(words(programs[name]["difference"]) for name in names[1:])]


def whole_frame(result: dict) -> list[str]:
    frame = result["whole_frame"]
    return [
        result["scene"],
        short(frame["octrace_s"]["median"]),
        short(frame["povray_s"]["median"]),
        short(frame["ratio"]),
        short(frame["octrace_rays"]["total"] / 1e6),
        f"{frame['difference']['color'] * 100.0:.2g} %",
    ]
