// SPDX-FileCopyrightText: 2026 mrpt_sgraphs developers
// SPDX-License-Identifier: BSD-3-Clause
//
// The plugin in rviz: found by its names, drawn, clicked on, asked. Without a screen rviz draws
// nothing, so that part is skipped.
#include <OgreCamera.h>
#include <OgreVector3.h>
#include <OgreViewport.h>
#include <dynamic_reconfigure/Config.h>
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <rviz/display.h>
#include <rviz/panel.h>
#include <rviz/properties/property_tree_model.h>
#include <rviz/render_panel.h>
#include <rviz/selection/selection_manager.h>
#include <rviz/view_controller.h>
#include <rviz/view_manager.h>
#include <rviz/visualization_manager.h>

#include <QApplication>
#include <QComboBox>
#include <QElapsedTimer>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <algorithm>
#include <cstdlib>
#include <pluginlib/class_loader.hpp>
#include <string>
#include <vector>

#include "graph_messages.h"
#include "mrpt_sgraphs/Optimize.h"

namespace mrpt_sgraphs {
namespace {

/// Lets rviz work until a condition holds.
template <typename Condition>
bool waitFor(const Condition& condition, int timeout_ms = 60000) {
  QElapsedTimer timer;
  timer.start();
  while (!condition()) {
    if (timer.elapsed() > timeout_ms) return false;
    QApplication::processEvents(QEventLoop::AllEvents, 20);
    ros::WallDuration(0.005).sleep();
  }
  return true;
}

TEST(RvizPlugin, IsFoundByItsNames) {
  pluginlib::ClassLoader<rviz::Display> displays("rviz", "rviz::Display");
  EXPECT_TRUE(displays.isClassAvailable("mrpt_sgraphs/SituationalGraph"));
  EXPECT_NE(displays.createUniqueInstance("mrpt_sgraphs/SituationalGraph"), nullptr);
  pluginlib::ClassLoader<rviz::Panel> panels("rviz", "rviz::Panel");
  EXPECT_TRUE(panels.isClassAvailable("mrpt_sgraphs/SituationalGraphPanel"));
  EXPECT_NE(panels.createUniqueInstance("mrpt_sgraphs/SituationalGraphPanel"), nullptr);
}

class Panel : public ::testing::Test {
 protected:
  Panel()
      : loader_("rviz", "rviz::Panel"),
        panel_(loader_.createUniqueInstance("mrpt_sgraphs/SituationalGraphPanel")) {
    setNameSpace("panel_test");
  }

  void setNameSpace(const QString& name_space) {
    rviz::Config config;
    config.mapSetValue("Namespace", name_space);
    panel_->load(config);
  }

  void click(const QString& text) {
    for (QPushButton* button : panel_->findChildren<QPushButton*>()) {
      if (button->text() == text) button->click();
    }
  }

  bool shows(const QString& text) const {
    for (const QLabel* label : panel_->findChildren<QLabel*>()) {
      if (label->text().contains(text)) return true;
    }
    return false;
  }

  pluginlib::ClassLoader<rviz::Panel> loader_;
  pluginlib::UniquePtr<rviz::Panel> panel_;
  ros::NodeHandle nh_{"panel_test"};
};

TEST_F(Panel, SaysThatNobodyAnswers) {
  click("Optimize");
  EXPECT_TRUE(waitFor([&] { return shows("Nobody serves /panel_test/optimize"); }));
}

TEST_F(Panel, WaitsForAnAnswerWithoutStandingStill) {
  constexpr double kWork_s = 2.0;
  const boost::function<bool(Optimize::Request&, Optimize::Response&)> work =
      [](Optimize::Request&, Optimize::Response& response) {
        ros::WallDuration(kWork_s).sleep();
        response.success = 0;
        response.message = "why it did not converge";
        return true;
      };
  ros::ServiceServer server = nh_.advertiseService("optimize", work);
  click("Optimize");
  QElapsedTimer timer;
  timer.start();
  qint64 longest_ms = 0;
  EXPECT_TRUE(waitFor([&] {
    longest_ms = std::max(longest_ms, timer.restart());
    return shows("why it did not converge");
  }));
  EXPECT_LT(longest_ms, 1000 * kWork_s / 2) << "the windows stood still";
}

TEST_F(Panel, ShowsSizesAndMode) {
  ros::Publisher graphs = nh_.advertise<SituationalGraph>("graph", 1, true);
  ros::Publisher modes =
      nh_.advertise<dynamic_reconfigure::Config>("hierarchy/parameter_updates", 1, true);
  graphs.publish(test::roomsMessage());
  dynamic_reconfigure::Config config;
  config.strs.resize(1);
  config.strs[0].name = "mode";
  config.strs[0].value = "paper";
  modes.publish(config);
  EXPECT_TRUE(waitFor([&] { return shows("<b>2</b> keyframes, and 1 marginalized"); }));
  EXPECT_TRUE(waitFor([&] { return panel_->findChild<QComboBox*>()->currentText() == "paper"; }));
}

TEST_F(Panel, RemembersItsNamespace) {
  setNameSpace("/another_robot");
  rviz::Config config;
  panel_->save(config);
  QString name_space;
  EXPECT_TRUE(config.mapGetString("Namespace", &name_space));
  EXPECT_EQ(name_space.toStdString(), "/another_robot");
}

/// One rviz for all: its materials are there once in a program.
class Display : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    if (std::getenv("DISPLAY") == nullptr) return;
    render_panel_ = new rviz::RenderPanel;
    render_panel_->resize(640, 480);
    manager_ = new rviz::VisualizationManager(render_panel_);
    render_panel_->initialize(manager_->getSceneManager(), manager_);
    manager_->initialize();
    manager_->setFixedFrame("map");
    manager_->startUpdate();
    render_panel_->show();
  }

  static void TearDownTestSuite() {
    delete manager_;
    delete render_panel_;
  }

  void SetUp() override {
    if (manager_ == nullptr) GTEST_SKIP() << "there is no screen: install xvfb";
    graphs_ = nh_.advertise<SituationalGraph>("display_test/graph", 1, true);
    display_ = manager_->createDisplay("mrpt_sgraphs/SituationalGraph", "graph", true);
    display_->setTopic("/display_test/graph", "");
  }

  void TearDown() override {
    if (manager_ != nullptr) manager_->removeAllDisplays();
  }

  void showAt(const SituationalGraph& msg, const Ogre::Vector3& focus, double distance_m) {
    rviz::ViewController* const view = manager_->getViewManager()->getCurrent();
    view->subProp("Distance")->setValue(distance_m);
    view->subProp("Focal Point")->subProp("X")->setValue(focus.x);
    view->subProp("Focal Point")->subProp("Y")->setValue(focus.y);
    view->subProp("Focal Point")->subProp("Z")->setValue(focus.z);
    graphs_.publish(msg);
    ASSERT_TRUE(waitFor([&] { return !status("Keyframes").empty(); })) << status("Graph");
    letItDraw();
  }

  void letItDraw() {
    const auto frames = manager_->getFrameCount();
    EXPECT_TRUE(waitFor([&] { return manager_->getFrameCount() > frames + 5; }));
  }

  /// By how its name begins: that of the status goes on with its level.
  static const rviz::Property* childNamed(const QString& name, const rviz::Property& parent) {
    for (int k = 0; k < parent.numChildren(); ++k) {
      if (parent.childAtUnchecked(k)->getName().startsWith(name)) {
        return parent.childAtUnchecked(k);
      }
    }
    return nullptr;
  }

  std::string status(const QString& name) const {
    const rviz::Property* const all = childNamed("Status", *display_);
    const rviz::Property* const line = all == nullptr ? nullptr : childNamed(name, *all);
    return line == nullptr ? "" : line->getValue().toString().toStdString();
  }

  /// Names of what is selected by a click on a place.
  std::vector<std::string> clickOn(const Ogre::Vector3& place) {
    Ogre::Viewport* const viewport = render_panel_->getViewport();
    const Ogre::Camera* const camera = viewport->getCamera();
    const Ogre::Vector3 seen = camera->getProjectionMatrix() * (camera->getViewMatrix() * place);
    const int x = static_cast<int>((0.5F + 0.5F * seen.x) * viewport->getActualWidth());
    const int y = static_cast<int>((0.5F - 0.5F * seen.y) * viewport->getActualHeight());
    auto* const selection = manager_->getSelectionManager();
    selection->select(viewport, x - 1, y - 1, x + 1, y + 1, rviz::SelectionManager::Replace);
    std::vector<std::string> names;
    const rviz::Property* const root = selection->getPropertyModel()->getRoot();
    for (int k = 0; k < root->numChildren(); ++k) {
      names.push_back(root->childAtUnchecked(k)->getNameStd());
    }
    return names;
  }

  ros::NodeHandle nh_;
  ros::Publisher graphs_;
  static rviz::RenderPanel* render_panel_;
  static rviz::VisualizationManager* manager_;
  rviz::Display* display_ = nullptr;  ///< The manager's.
};

rviz::RenderPanel* Display::render_panel_ = nullptr;
rviz::VisualizationManager* Display::manager_ = nullptr;

TEST_F(Display, SaysWhatANodeIsThatIsClickedOn) {
  SituationalGraph msg = test::roomsMessage();
  const auto& keyframe = msg.keyframes[2].pose.position;
  const Ogre::Vector3 at_keyframe(keyframe.x, keyframe.y, keyframe.z);
  showAt(msg, at_keyframe, 4.0);
  EXPECT_EQ(clickOn(at_keyframe), std::vector<std::string>{"keyframe 2"});
  const rviz::Property* const node =
      manager_->getSelectionManager()->getPropertyModel()->getRoot()->childAtUnchecked(0);
  EXPECT_EQ(node->childAtUnchecked(0)->getNameStd(), "id");
  EXPECT_EQ(node->childAtUnchecked(0)->getValue().toString().toStdString(), "2");

  msg.keyframes[2].stamp = ros::Time(1700000000.0);
  graphs_.publish(msg);
  EXPECT_TRUE(waitFor([&] {
    return node->childAtUnchecked(1)->getValue().toString() == "1700000000.000000";
  })) << "what is shown of it follows the graph";
  EXPECT_TRUE(clickOn(at_keyframe + Ogre::Vector3(0.0F, 0.0F, 0.9F)).empty());
}

TEST_F(Display, SelectsAWallAnywhereOnIt) {
  SituationalGraph msg = test::roomsMessage();
  msg.factors.clear();
  const Ogre::Vector3 corner(3.0F, -1.7F, 12.2F);  // off its middle, lifted by 10 m
  showAt(msg, corner, 6.0);
  auto* const view = manager_->getViewManager()->getCurrent();
  view->subProp("Yaw")->setValue(3.14159);  // from its own side
  view->subProp("Pitch")->setValue(0.0);
  letItDraw();
  EXPECT_EQ(clickOn(corner), std::vector<std::string>{"wall 4"});
  view->subProp("Yaw")->setValue(0.0);
  letItDraw();
  EXPECT_TRUE(clickOn(corner).empty()) << "nothing is seen of it from behind";
}

TEST_F(Display, SaysHowManyKeyframesItThins) {
  SituationalGraph msg;
  msg.header.frame_id = "map";
  for (std::uint64_t k = 0; k < 5000; ++k) {
    GraphKeyframe keyframe;
    keyframe.id = keyframe.representative = k;
    keyframe.pose.position.x = 0.02 * static_cast<double>(k);
    keyframe.pose.orientation.w = keyframe.odom_pose.orientation.w = 1.0;
    keyframe.floor = keyframe.room = GraphKeyframe::NONE;
    msg.keyframes.push_back(keyframe);
  }
  showAt(msg, Ogre::Vector3(50.0F, 0.0F, 0.0F), 300.0);
  const std::string text = status("Keyframes");
  EXPECT_NE(text.find(" of 5000 keyframes (far ones thinned)"), std::string::npos) << text;
  manager_->getViewManager()->getCurrent()->subProp("Distance")->setValue(10.0);
  EXPECT_TRUE(waitFor([&] { return status("Keyframes") != text; })) << "as the camera comes near";
}

TEST_F(Display, SaysWhatIsWrongWithAGraph) {
  SituationalGraph msg = test::roomsMessage();
  msg.keyframes[1].id = 0;
  graphs_.publish(msg);
  EXPECT_TRUE(waitFor([&] { return status("Graph").find("keyframe 0") != std::string::npos; }))
      << status("Graph");
}

}  // namespace
}  // namespace mrpt_sgraphs

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "test_rviz_plugin");
  if (std::getenv("DISPLAY") == nullptr) setenv("QT_QPA_PLATFORM", "offscreen", 1);
  QApplication application(argc, argv);
  ros::AsyncSpinner spinner(2);
  spinner.start();
  return RUN_ALL_TESTS();
}
