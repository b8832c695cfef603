"""What a person does with a page, for tests that drive one in a browser."""

DESK = {"width": 1280, "height": 720}
PHONE = {"width": 390, "height": 844}
SHOWN = "Array.from(new Uint8Array(shoal.frame()))"  # the bytes of the frame shown


def pause(page):
    page.get_by_role("button", name="Pause").click()
    page.wait_for_function("() => !shoal.playing()")


def play(page):
    page.get_by_role("button", name="Play").click()
    page.wait_for_function("() => shoal.playing()")


def slide(page, name, key, times):
    slider = page.get_by_role("slider", name=name)
    slider.focus()
    for _ in range(times):
        slider.press(key)


def first_living_agent(page):
    """Where on the page the first agent that is there is drawn [px]."""
    x, y = page.evaluate(
        """() => {
            const view = new DataView(shoal.frame());
            const [agents, targets] = [view.getUint32(8, true), view.getUint32(12, true)];
            const flags = 84 + 22 * agents + 8 * targets;
            const agent = [...Array(agents).keys()].find((each) => view.getUint8(flags + each) & 2);
            return [view.getFloat32(84 + 4 * agent, true), view.getFloat32(84 + 4 * (agents + agent), true)];
        }"""
    )
    return place(page, x, y)


def place(page, x, y):
    """Where on the page a point of the arena [m] is drawn [px]."""
    box = page.locator("canvas").first.bounding_box()
    to = page.evaluate("([x, y]) => shoal.place(x, y)", [x, y])
    return box["x"] + to[0], box["y"] + to[1]
