"""Small text formats, each rule broken once."""
SKIN = """<source id="n"><Name_array id="a" count="2">low high</Name_array></source><vertex_weights count="1">
<input semantic="JOINT" source="#n" offset="0"/><input semantic="WEIGHT" source="#w" offset="1"/><vcount>1</vcount><v>0 7 1 8</v></vertex_weights>"""
TEXTS = {
    "dae": [SKIN, SKIN.replace("1 8", "2 8"), SKIN.replace("0 7", "-1 7"), SKIN.replace("</v>", ""), SKIN.replace("Name_array", "IDREF_array"),
            SKIN.replace("#n", "#m"), SKIN.replace("</source>", ""), '<?xml version="1.0"?><!DOCTYPE x [<!ENTITY a "b">]>' + SKIN,
            '<node id="a"><instance_node url="#a"/></node>', '<node id="a"/><node id="b"><instance_node url="#a"/><instance_node url="#a"/></node>',
            '<node id="a"><node id="b" name=\'>\'><instance_node url="#a"/></node></node>', '<node id="a"><!-- <node id="b"> --><![CDATA[<node>]]></node></node>',
            "".join(f'<node id="n{i}">' + 2 * f'<instance_node url="#n{i - 1}"/>' + "</node>" for i in range(20)), "<node" * 9, "<!--", "<![CDATA["],
    "dmat": ["2 2\n1 2 3 4\n", "2 2\n1 2 3\n", "2 2\n1 2 3 4 5\n", "0 0\n", "2\n", "x\n", "-1 2\n", "2 2\n1 2 nan 4\n", "2 2\n1 2 x 4\n",
             "99999999 99999999\n1", "0 0\n2 1\n" + "\0" * 16, "0 0\n2 1\n" + "\0" * 15, "0 0\n1 1\n\0\0\0\0\0\0\xf0\x7f", "0 0\nx\n", "1 0\n", "0 0\n99999999 99999999\n"],
    "tgf": ["1 0 0 0\n2 0 1 0\n#\n1 2\n", "1 0 0 0\n#\n1 1\n", "1 0 0 x\n#\n", "1 0 0 0\n1 0 0 0\n#\n1 2\n", "1 0 0 inf\n#\n1 1\n", "#\n", ""],
    "off": ["OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "OFF\n3 1 0\n0 0 0 255 0 0\n1 0 0\n0 1 0\n3 0 1 2 9\n", "OFF 3 1 0\n# c\n0 0 0\n1 0 0\n0 1 0\n3 0 1 9\n",
            "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n2 0 1\n", "OFF\n3 1 0\n0 0 0\n", "OFF\n-1 1 0\n", "OFF\n3 x 0\n", "OFF\n3 1 0\n0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
            "COFF\n", "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1\n", "OFF\n3 1 0\n0 0 inf\n1 0 0\n0 1 0\n3 0 1 2\nrest\n"],
    "obj": ["v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "v 0 0 0\nf 1//1 -1/2/3 9\n", "v 0 0\n", "v 0 0 x\n", "vn 0 0 1\nvt 0 0\nusemtl a\nmtllib a.mtl\nf 1 2\n", "f 0 1 2\n", "f a b c\n",
            "v 0 0 0 \\\n1\n", "newmtl a\nmap_Kd ../a.png\n"],
}


def seeds():
    for target, texts in TEXTS.items():
        for text in texts:
            yield target, text.encode("latin-1")
