"""Whether an operator can run, and the sentence that says why not where a person points at its button."""

from bpy.app.translations import pgettext_tip as tip_


def own_scene(cls, context) -> bool:
    """The scene can be changed: it is not linked from another file."""
    library = context.scene.library
    if library is not None:
        sentence = tip_("This scene is linked; open {file}, or append the scene instead")
        cls.poll_message_set(sentence.format(file=library.filepath))
    return library is None


def own_picture(cls, context) -> bool:
    """The scene can be changed, and has a picture."""
    if not own_scene(cls, context):
        return False
    if context.scene.stillwater.active() is None:
        cls.poll_message_set(tip_("The scene has no Stillwater picture yet: open one first"))
        return False
    return True


def on_a_plane(cls, context) -> bool:
    """Whether the active picture has a plane to draw on, where there is one."""
    if context.scene.stillwater.active().plane is None:
        cls.poll_message_set(tip_("The picture has no plane in the scene; make it anew with Set Up in Scene"))
        return False
    return True
